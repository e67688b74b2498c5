"""Roles of mechanisms that act on the blood: branches of the circuit and pressures of its compartments."""

from abc import abstractmethod
from typing import ClassVar

import numpy as np

from heartfit.branch import Branch
from heartfit.geometry.arrays import Floats
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


class Pressure(Mechanism):
    """A pressure added to that of prescribed compartments."""

    @abstractmethod
    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:
        """Pressure added to ``compartment`` at ``time`` (any shape), Pa; periodic in ``period``."""
