"""Forms of errors of an instrument: free in time, free in the measured value, or of its clock."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.places.place import FunctionOfState, FunctionOfTime
from heartfit.roles import Sensor

LENGTHS = (0.05, 0.025, 0.1)
"""Correlation lengths [s]: instruments may err faster than a heart."""


@dataclass(frozen=True)
class ErrorInTime(FunctionOfTime, Sensor):
    """An error of the curve that is a function of time."""

    LENGTHS = LENGTHS
    zero = "trigger"

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:  # noqa: ARG002
        return values + self.function.at(times)


@dataclass(frozen=True)
class ErrorWhileHigh(ErrorInTime):
    """An error that is a function of time, in proportion to the curve above its least: a catheter that is struck."""

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:  # noqa: ARG002
        return values + (values - values.min()) / np.ptp(values) * self.function.at(times)


@dataclass(frozen=True)
class ErrorInValue(FunctionOfState, Sensor):
    """An error of the curve that is a function of its value, between its least and its largest."""

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:  # noqa: ARG002
        return values + self.function.at((values - values.min()) / np.ptp(values))


@dataclass(frozen=True)
class ErrorOfClock(FunctionOfTime, Sensor):
    """A delay of the curve [s] that is a function of time."""

    unit = "s"
    amplitude = 0.02
    zero = "trigger"

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        return np.interp(times - self.function.at(times), times, values, period=period)
