"""Roles of mechanisms: a role fixes the place at which an effect enters the equations of the heart.

Amendment, Attachment, Availability, Delay, Relaxation and Stress act on the muscle: on its constants, fibres, control
and elasticity. The ventricles are made of :attr:`heartfit.heart.heart.Heart.muscle`, the tissue as these mechanisms
change it. Flow, Dynamics, Narrowing, Pressure, Contraction, Chamber and External act on the blood, and a Sensor on the
measurement alone.
"""

from abc import ABC, abstractmethod
from dataclasses import replace
from typing import ClassVar, Literal, Self

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import Parameter, parameters_of
from heartfit.roles.chamber import Atrium
from heartfit.roles.laws import Branch, Leaflets, Load


class Mechanism(ABC):  # noqa: B024
    """Base class of all roles: a part with exactly one switch."""

    @classmethod
    def switch(cls) -> Parameter:
        """Return the parameter that turns the mechanism off; raises ``TypeError`` unless there is exactly one."""
        switches = [declared for declared in parameters_of(cls) if declared.off is not None]
        if len(switches) != 1:
            raise TypeError(
                f"{cls.__name__} declares {len(switches)} parameters with an off value: expected one"
            )
        return switches[0]

    def turned_off(self) -> Self:
        """Return the same mechanism at its off value."""
        return replace(self, **{self.switch().name: self.switch().off})  # type: ignore[type-var]


class Amendment(Mechanism):
    """A change of one constant of the tissue."""

    amends: ClassVar[str]
    """Dotted path of the parameter below the tissue, as "active.starling.slope"."""

    @abstractmethod
    def amend(self, value: float, period: float) -> float:
        """Return the amended ``value`` of the constant in a heart of that ``period`` [s]."""


class Availability(Mechanism):
    """A loss of cross-bridges in a part of the wall: they carry no stress and no stiffness."""

    @abstractmethod
    def lost_share(self) -> Floats:
        """Lost share (18,) of the bridges in the right ventricular wall and in each AHA segment."""


class Delay(Mechanism):
    """A later activation of a part of the wall."""

    @abstractmethod
    def delay(self) -> Floats:
        """Delay (18,) [s] of the activation of the right ventricular wall and of each AHA segment."""


class Attachment(Mechanism):
    """A changed attachment of the bridges: a share of the rate k_ATP is added at some times after activation."""

    @abstractmethod
    def added_integral(self, time: Floats) -> Floats:
        """Integral [s] of the added share over [0, ``time``] after activation (any shape); no rate is negative."""


class Relaxation(Mechanism):
    """A slower detachment of the bridges: part of the rate k_RS is missing at some times after repolarisation."""

    @abstractmethod
    def missing_integral(self, time: Floats) -> Floats:
        """Integral [s] of the missing share of the rate over [0, ``time``] after repolarisation (any shape)."""


class Stress(Mechanism):
    r"""Energy W(x) [Pa] of one invariant of the isochoric deformation, in addition to that of the passive law.

    x is :math:`\bar I_1 - 3` of the wall, or :math:`\bar I_{4f} - 1` of the fibre; both vanish in the reference.
    """

    acts_on: ClassVar[Literal["wall", "fibre"]]

    @abstractmethod
    def slopes(self, x: Floats) -> tuple[Floats, Floats]:
        """First and second derivative of W by x (any shape) [Pa]."""


COMPARTMENTS = ("lv", "rv", "aorta", "pulmonary_artery", "left_atrium", "right_atrium")


class Flow(Mechanism):
    """A branch of the circuit from ``upstream`` to ``downstream``."""

    upstream: ClassVar[str]
    downstream: ClassVar[str]

    @abstractmethod
    def law(self, time: Floats) -> Branch:
        """Return the branch at ``time`` (any shape) [s]: its coefficients are numbers or of that shape."""

    def flow(self, time: float, drop: float) -> tuple[float, float]:
        """Flow [m^3/s] at the pressure drop upstream - downstream [Pa], and its derivative by the drop."""
        return self.law(np.asarray(time)).flow(drop)


class Narrowing(Mechanism):
    r"""A loss of pressure in series with a valve: :math:`\tfrac12 \rho a q^2` of its forward drop."""

    valve: ClassVar[str]
    """Name of the valve: "mitral", "aortic", "tricuspid" or "pulmonary"."""

    @abstractmethod
    def inverse_square(self) -> float:
        """Inverse square a = 1/A^2 [1/m^4] of the narrowing's effective area A."""


class Dynamics(Narrowing):
    """Inertia of the blood in a valve and leaflets that take time to move: flow and opening become states.

    The narrowing is the loss of pressure by which the blood gains its speed in the valve.
    """

    @abstractmethod
    def leaflets(self) -> Leaflets:
        """Inertance of the blood in the valve, and rates of its opening and closing."""


class Pressure(Mechanism):
    """A pressure added to that of atria or arteries."""

    compartments: ClassVar[tuple[str, ...]]
    """Names of the compartments on which it acts."""

    @abstractmethod
    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:
        """Pressure [Pa] added to a compartment at ``time`` (any shape) [s]; periodic in ``period`` [s]."""


class Contraction(Pressure):
    """Systole of the atria: the pressure that it adds to atria of prescribed pressure.

    An atrium with a volume contracts by its active elastance instead, in proportion to :meth:`contraction`.
    """

    @abstractmethod
    def contraction(self, time: Floats, period: float) -> Floats:
        """Contraction e at ``time`` (any shape) [s], periodic in ``period`` [s]: 1 at the peak of a normal systole."""


class Chamber(Mechanism):
    """A volume of an atrium, filled by veins: its pressure follows from its volume."""

    compartment: ClassVar[Literal["left_atrium", "right_atrium"]]

    @abstractmethod
    def atrium(self) -> Atrium:
        """Coefficients of the law; a resistance of 0 leaves the pressure of the atrium prescribed."""


class External(Mechanism):
    """A pressure on the outside of the ventricles, which their walls transmit to their cavities."""

    @abstractmethod
    def load(self, ventricle: str, time: Floats, period: float) -> Load:
        """Load of "lv" or "rv" at ``time`` (any shape) [s]: numbers or arrays of that shape; periodic in ``period``."""


class Sensor(Mechanism):
    """The distortion of a curve by an instrument: it enters the measurement and has no effect on the heart.

    Several sensors act one after the other, in the order in which they were added to the heart.
    """

    measures: ClassVar[tuple[str, ...]]
    """Names of the curves that it measures, as :meth:`heartfit.heart.beat.Beat.signals` gives them."""

    @abstractmethod
    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        """Distort the periodic curve ``values`` (t,) [SI] at ``times`` (t,) [s] after the trigger."""
