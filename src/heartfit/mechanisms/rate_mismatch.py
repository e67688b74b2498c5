"""Rate mismatch: images of a breath-hold in which the heart beat at another rate than the stated one."""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.core.parameter import parameter, require_admissible
from heartfit.roles import Sensor, mechanism


@mechanism
@dataclass(frozen=True)
class RateMismatch(Sensor):
    r"""Volume curve of a beat with a longer diastole, shown over the stated period T.

    .. math:: T' = T + a (T - T_s), \quad V'(t) = V(\theta), \quad
              \theta = \begin{cases} s & s < T_s \\ T_s + (s - T_s) / (1 + a) & s \ge T_s, \end{cases} \quad
              s = \frac{T'}{T} t

    Systole, until :math:`T_s` after the trigger, has the same duration at any rate; diastole lasted
    1 + a times as long. A scanner that spreads its frames over one stated beat shows systole too early and diastole too
    long, a > 0, or the opposite.
    Source: ours; that systole hardly follows the rate: Weissler, Harris and Schoenfeld, Circulation 1968, 37:149.
    """

    measures = ("lv_volume", "rv_volume")
    stretch: float = parameter(
        0.1,
        unit="1",
        symbol="a",
        meaning="relative lengthening of diastole",
        off=0.0,
        low=-0.9,
        scale=0.1,
    )
    systole: float = parameter(
        0.36, unit="s", symbol="T_s", meaning="end of systole after the trigger", scale=0.02
    )

    def __post_init__(self) -> None:
        require_admissible(self)

    def distort(self, times: Floats, values: Floats, period: float) -> Floats:
        if not self.systole < period:
            raise InputError(
                f"RateMismatch.systole = {self.systole:g} s: expected less than the period, {period:g} s"
            )
        distorted, undistorted = (
            np.interp(instants, times, values, period=period)
            for instants in (self._true_times(times, period), times)
        )
        # this form is exact at a = 0
        result: Floats = values + (distorted - undistorted)
        return result

    def _true_times(self, times: Floats, period: float) -> Floats:
        """True times [s] of the states that the images show at ``times`` [s] after the trigger."""
        start = np.floor(times / period) * period
        spread = (times - start) * (1.0 + self.stretch * (period - self.systole) / period)
        late = np.maximum(spread - self.systole, 0.0)
        true_times: Floats = start + spread - late * self.stretch / (1.0 + self.stretch)
        return true_times
