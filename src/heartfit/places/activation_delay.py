"""A delay of the activation of the wall."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.geometry.territory import ACTIVATION_ORDER, REGIONS
from heartfit.places.place import FunctionOfState
from heartfit.roles import Delay


@dataclass(frozen=True)
class ActivationDelay(FunctionOfState, Delay):
    r"""Delay :math:`f(u) - f(0)` [s] of the AHA segments by their rank u, 0 to 1, in the order of activation in health.

    It may be negative. The segment that is first in health and the right ventricular wall keep their activation.
    """

    region = "muscle"
    slot = "the activation of parts of the wall"
    unit = "s"
    amplitude = 0.03

    def delay(self) -> Floats:
        delays = np.zeros(REGIONS)
        ranks = np.arange(len(ACTIVATION_ORDER)) / (len(ACTIVATION_ORDER) - 1.0)
        values = self.function.at(ranks)
        delays[ACTIVATION_ORDER] = values - values[0]
        return delays
