"""An error of the measured pressure while it is high."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.places.sensor import ErrorInTime


@dataclass(frozen=True)
class SystolicPressureError(ErrorInTime):
    """Error [Pa] at a time of the beat, in proportion to the pressure above its least: a catheter that is struck."""

    region = "catheter"
    slot = "the measured pressure in systole"
    unit = "Pa"
    amplitude = 2000.0
    measures = ("lv_pressure",)

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:  # noqa: ARG002
        return values + (values - values.min()) / np.ptp(values) * self.function.at(times)
