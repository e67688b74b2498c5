"""Roles of mechanisms that act on the muscle: on its constants, its fibres, its control and its elasticity.

The ventricles are made of :attr:`heartfit.heart.Heart.muscle`, the tissue with what these mechanisms make of it.
"""

from abc import abstractmethod
from typing import ClassVar, Literal

from heartfit.geometry.arrays import Floats
from heartfit.mechanism.base import Mechanism


class Amendment(Mechanism):
    """Another value of one constant of the tissue."""

    amends: ClassVar[str]
    """Dotted path of the parameter below the tissue, as "active.starling.slope"."""

    @abstractmethod
    def amended(self, value: float, period: float) -> float:
        """What the ``value`` of the slot becomes in a heart of that ``period``, s."""


class Availability(Mechanism):
    """Cross-bridges that are missing in a part of the wall: they carry no stress and no stiffness."""

    @abstractmethod
    def lost(self) -> Floats:
        """Share (18,) of the bridges that is missing in the right ventricular wall and in each AHA segment."""


class Delay(Mechanism):
    """A later activation of a part of the wall."""

    @abstractmethod
    def delay(self) -> Floats:
        """Time (18,), s, >= 0, by which the right ventricular wall and each AHA segment is activated later."""


class Relaxation(Mechanism):
    """A slower detachment of the bridges: part of the rate k_RS is missing at some times after repolarisation."""

    @abstractmethod
    def missing(self, time: Floats) -> Floats:
        """Integral, s, of the missing share of the rate over [0, ``time``] after repolarisation (any shape)."""


class Stress(Mechanism):
    r"""Energy W(x), Pa, of one invariant of the isochoric deformation, beside that of the passive law.

    x is :math:`\bar I_1 - 3`, or, ``of`` the fibre, :math:`\bar I_{4f} - 1`; both vanish in the reference.
    """

    of: ClassVar[Literal["wall", "fibre"]]

    @abstractmethod
    def slopes(self, x: Floats) -> tuple[Floats, Floats]:
        """First and second derivative of W by x (any shape), Pa."""
