"""A rate of detachment of the bridges."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.places.place import FunctionOfState
from heartfit.roles import Relaxation


@dataclass(frozen=True)
class DetachmentRate(FunctionOfState, Relaxation):
    r"""Factor :math:`e^{f(t)}` on the rate k_RS at the time t after repolarisation, up to SPAN [s]."""

    region = "muscle"
    slot = "the rate at which the bridges of the muscle detach"
    unit = "1"
    amplitude = 0.5
    SPAN = 0.5
    GRID = 200
    """Number of intervals over which the factor is integrated."""

    def missing_integral(self, time: Floats) -> Floats:
        ends = np.linspace(0.0, self.SPAN, self.GRID + 1)
        missing = -np.expm1(self.function.at(0.5 * (ends[:-1] + ends[1:]) / self.SPAN))
        integral = np.concatenate([[0.0], np.cumsum(missing) * self.SPAN / self.GRID])
        return np.interp(time, ends, integral)
