r"""Filling indices of a volume curve: the waves of its rate, and the dip of diastasis.

Echocardiography reads them from the velocity of the mitral inflow (Nagueh et al. 2016, doi:10.1016/j.echo.2016.01.011);
here they are read from the flow, the rate of the volume. The ratios E/A of flows and of velocities correlate with
r = 0.80 between persons, and the slope is near one (doi:10.1186/1532-429X-13-S1-P32).

- E and A: largest rates early and late in filling, two local maxima with a lower rate between them.
- Dip: the largest fall of the volume between E and A.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.observation.beat import ATRIAL_PEAK_LIMIT, EARLY_PEAK_LIMIT
from heartfit.observation.curve import Curve
from heartfit.observation.operator import VolumeFeatures


@dataclass(frozen=True, eq=False)
class _Filling:
    """Flow and volume (k,) at the times (k,) [s] from the first to the last forward flow of a filling."""

    times: Floats
    flow: Floats
    volume: Floats

    def waves(self) -> tuple[int, int]:
        """Samples of E and A; raises InputError unless there are two waves with a lower flow between them."""
        first = 1 + int(EARLY_PEAK_LIMIT * self.times.size)
        last = int(ATRIAL_PEAK_LIMIT * self.times.size)
        early, atrial = int(self.flow[:first].argmax()), last + int(self.flow[last:].argmax())
        if early == first - 1 or atrial == last or self.flow[early : atrial + 1].min() >= self.flow[atrial]:
            raise InputError(
                "filling: the flow has no early and atrial wave with a lower flow between them; expected two "
                "waves: at a fast rate, or without an atrial kick, they are one"
            )
        return early, atrial


def volume_indices(volume: Curve, features: VolumeFeatures | None = None) -> dict[str, float]:
    """Return E, A, their ratio and times, and the dip, of a volume curve alone; its rate is the flow.

    features: frames and window of the rate; by default the samples of the curve and central differences. Filling lasts
    from the least volume to the end of positive flow before ejection. Raises InputError unless there are two waves.
    """
    operator = features or VolumeFeatures(volume.times.size)
    rate, smooth = operator.rate(volume), operator.smooth(volume)
    start = int(rate.values.argmin())
    flow, filled = _from_sample(rate, start), _from_sample(smooth, start)
    least = int(filled.values[: flow.times.size // 2].argmin())
    end = int(np.flatnonzero(flow.values > 0.0)[-1]) + 1
    filling = _Filling(flow.times[least:end], flow.values[least:end], filled.values[least:end])
    return _wave_indices(filling, *filling.waves(), volume.period)


def _wave_indices(filling: _Filling, early: int, atrial: int, period: float) -> dict[str, float]:
    peaks, between = filling.flow[[early, atrial]], filling.volume[early : atrial + 1]
    times = np.mod(filling.times[[early, atrial]], period)
    return {
        "E": float(peaks[0]),
        "A": float(peaks[1]),
        "E/A": float(peaks[0] / peaks[1]),
        "time of E": float(times[0]),
        "time of A": float(times[1]),
        "dip": float((np.maximum.accumulate(between) - between).max()),
    }


def _from_sample(curve: Curve, first: int) -> Curve:
    """The curve from sample ``first`` on, its times increasing over one period."""
    times = np.concatenate([curve.times[first:], curve.times[:first] + curve.period])
    return Curve(times, np.roll(curve.values, -first), curve.period)
