r"""Filling indices of a beat: the waves of the mitral flow, the intervals between the valves, and the dip of diastasis.

Echocardiography reads them from the velocity of the mitral inflow (Nagueh et al. 2016, doi:10.1016/j.echo.2016.01.011);
here they are read from its flow. The ratios E/A of flows and of velocities correlate with r = 0.80 between persons, and
the slope is near one (doi:10.1186/1532-429X-13-S1-P32).

- E and A: largest forward flows early and late in filling, two local maxima with a lower flow between them.
- Deceleration time: from E to the zero of the line through the points of the descending limb at 0.8 E and 0.5 E.
- Isovolumic relaxation: from the closing of the aortic to the opening of the mitral valve.
- Isovolumic contraction: from the end of forward mitral flow to the opening of the aortic valve.
- Dip: the largest fall of the volume between E and A.
- Backflow: the volume that returns to the atrium between A and the opening of the aortic valve.

Valves open and close where the flow crosses a small share of its peak, on a straight line between samples. Flows and
volume are sampled at equal times.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.observation.beat import ATRIAL_PEAK_LIMIT, EARLY_PEAK_LIMIT, OPEN_FLOW_FRACTION
from heartfit.observation.curve import Curve
from heartfit.observation.operator import VolumeFeatures, require_curves

UPPER_LIMB, LOWER_LIMB = 0.8, 0.5
"""Shares of E between which the descending limb gives the deceleration."""

UNITS = {
    "E": "m^3/s",
    "A": "m^3/s",
    "E/A": "1",
    "time of E": "s",
    "time of A": "s",
    "deceleration time": "s",
    "isovolumic relaxation": "s",
    "isovolumic contraction": "s",
    "dip": "m^3",
    "backflow": "m^3",
}
"""SI units of the indices by name; times of peaks are after the trigger, within the period."""


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


def filling_indices(curves: Mapping[str, Curve]) -> dict[str, float]:
    """Return all indices by name, with the units of UNITS, of a beat's "aortic_flow", "mitral_flow" and "lv_volume".

    The curves share their times, which start anywhere. Raises ValueError for a missing curve, and InputError for a
    valve that never closes, for a beat without two waves, and for an early wave that does not fall to half before the
    atrial one.
    """
    require_curves(curves, ("aortic_flow", "mitral_flow", "lv_volume"))
    start = int(curves["aortic_flow"].values.argmax())
    aortic, mitral, volume = (
        _from_sample(curves[name], start) for name in ("aortic_flow", "mitral_flow", "lv_volume")
    )
    _, closing, ejection, _ = _crossings(aortic)
    opening, _, _, end = _crossings(mitral)
    inside = (mitral.times >= opening) & (mitral.times <= end)
    filling = _Filling(mitral.times[inside], mitral.values[inside], volume.values[inside])
    early, atrial = filling.waves()
    after = (mitral.times >= filling.times[atrial]) & (mitral.times <= ejection)
    backward = np.minimum(mitral.values[after], 0.0)
    return {
        **_wave_indices(filling, early, atrial, mitral.period),
        "deceleration time": _deceleration_time(filling, early, atrial),
        "isovolumic relaxation": opening - closing,
        "isovolumic contraction": ejection - end,
        "backflow": float(-np.trapezoid(backward, mitral.times[after])),
    }


def volume_indices(volume: Curve, features: VolumeFeatures | None = None) -> dict[str, float]:
    """Return E, A, their ratio and times, and the dip, of a volume curve alone; its rate is the flow.

    features: frames and window of the rate; by default the samples of the curve and central differences. Filling lasts
    from the least volume to the end of positive flow before ejection. Raises InputError as :func:`filling_indices`
    does.
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


def _deceleration_time(filling: _Filling, early: int, atrial: int) -> float:
    times, flow = filling.times[early : atrial + 1], filling.flow[early : atrial + 1]
    if flow.min() > LOWER_LIMB * flow[0]:
        raise InputError(
            f"filling: between E and A the flow falls to {flow.min() / flow[0]:.2f} E only; expected less than "
            f"{LOWER_LIMB:g} E for a deceleration time: the atrial wave begins too early"
        )
    upper, lower = (_first_crossing(times, share * flow[0] - flow) for share in (UPPER_LIMB, LOWER_LIMB))
    return float(upper + UPPER_LIMB * (lower - upper) / (UPPER_LIMB - LOWER_LIMB) - times[0])


def _from_sample(curve: Curve, first: int) -> Curve:
    """The curve from sample ``first`` on, its times increasing over one period."""
    times = np.concatenate([curve.times[first:], curve.times[:first] + curve.period])
    return Curve(times, np.roll(curve.values, -first), curve.period)


def _crossings(flow: Curve) -> tuple[float, float, float, float]:
    """First opening and closing, last opening and closing [s] of a valve by its forward flow."""
    excess = flow.values - OPEN_FLOW_FRACTION * flow.values.max()
    times, excess = np.append(flow.times, flow.times[0] + flow.period), np.append(excess, excess[0])
    opens, closes = (_all_crossings(times, sign * excess) for sign in (1.0, -1.0))
    if not (opens.size and closes.size):
        raise InputError(
            "filling: a valve never opens or never closes; expected a beat in which both valves do"
        )
    return float(opens[0]), float(closes[0]), float(opens[-1]), float(closes[-1])


def _first_crossing(times: Floats, rising: Floats) -> float:
    return float(_all_crossings(times, rising)[0])


def _all_crossings(times: Floats, rising: Floats) -> Floats:
    """Times at which ``rising`` passes zero upwards, on straight lines between samples."""
    at = np.flatnonzero((rising[:-1] <= 0.0) & (rising[1:] > 0.0))
    share = rising[at] / (rising[at] - rising[at + 1])
    crossings: Floats = times[at] + share * (times[at + 1] - times[at])
    return crossings
