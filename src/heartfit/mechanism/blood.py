"""Roles of mechanisms that act on the blood: branches of the circuit, and pressures in and around compartments."""

from abc import abstractmethod
from typing import ClassVar

import numpy as np

from heartfit.branch import Branch
from heartfit.geometry.arrays import Floats
from heartfit.load import Load
from heartfit.mechanism.base import Mechanism

COMPARTMENTS = ("lv", "rv", "aorta", "pulmonary_artery", "left_atrium", "right_atrium")


class Flow(Mechanism):
    """A branch of the circuit from ``upstream`` to ``downstream``."""

    upstream: ClassVar[str]
    downstream: ClassVar[str]

    @abstractmethod
    def law(self, time: Floats) -> Branch:
        """The branch at ``time``, s (any shape): its coefficients are numbers or of that shape."""

    def flow(self, time: float, drop: float) -> tuple[float, float]:
        """Flow, m^3/s, at the pressure drop upstream - downstream, Pa, and its derivative by the drop."""
        return self.law(np.asarray(time)).flow(drop)


class Narrowing(Mechanism):
    r"""A loss of pressure in series with a valve: :math:`\tfrac12 \rho a q^2` of its forward drop."""

    valve: ClassVar[str]
    """Name of the valve: "mitral", "aortic", "tricuspid" or "pulmonary"."""

    @abstractmethod
    def inverse_square(self) -> float:
        """a = 1/A^2, 1/m^4, of the narrowing's effective area A."""


class Pressure(Mechanism):
    """A pressure added to that of atria or arteries."""

    compartments: ClassVar[tuple[str, ...]]
    """Names of the compartments on which it acts."""

    @abstractmethod
    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:
        """Pressure added to one of them at ``time`` (any shape), s, in Pa; periodic in ``period``."""


class External(Mechanism):
    """A pressure on the outside of the ventricles, which their walls hand on to their cavities."""

    @abstractmethod
    def load(self, ventricle: str, time: Floats, period: float) -> Load:
        """Load of "lv" or "rv" at ``time`` (any shape), s: numbers or arrays of that shape; periodic in ``period``."""
