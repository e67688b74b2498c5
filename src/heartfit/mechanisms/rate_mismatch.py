"""Rate mismatch: images of a breath-hold in which the heart beat at another rate than is stated."""

from dataclasses import dataclass

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.mechanism import Sensor, mechanism
from heartfit.parameter import parameter, require_admissible


@mechanism
@dataclass(frozen=True)
class RateMismatch(Sensor):
    r"""Volume curve of a beat with a longer diastole, shown over the stated period T.

    .. math:: T' = T + a (T - T_s), \quad V'(t) = V(\theta), \quad
              \theta = \begin{cases} s & s < T_s \\ T_s + (s - T_s) / (1 + a) & s \ge T_s, \end{cases} \quad
              s = \frac{T'}{T} t

    Systole, until :math:`T_s` after the trigger, takes its own time at any rate; diastole was 1 + a as long. A scanner
    that spreads its frames over one stated beat shows systole too early and diastole too long, a > 0, or the
    opposite.
    Source: ours; that systole hardly follows the rate: Weissler, Harris and Schoenfeld, Circulation 1968, 37:149.
    """

    measures = ("lv_volume", "rv_volume")
    stretch: float = parameter(
        0.1,
        unit="1",
        symbol="a",
        meaning="by which fraction diastole was longer",
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
        shown, simulated = (
            np.interp(each, times, values, period=period) for each in (self._true(times, period), times)
        )
        # the form that leaves the values bit for bit at a = 0
        changed: Floats = values + (shown - simulated)
        return changed

    def _true(self, times: Floats, period: float) -> Floats:
        """When the heart was where the images show it at ``times``, s after the trigger."""
        early = np.floor(times / period) * period
        spread = (times - early) * (1.0 + self.stretch * (period - self.systole) / period)
        late = np.maximum(spread - self.systole, 0.0)
        true: Floats = early + spread - late * self.stretch / (1.0 + self.stretch)
        return true
