"""Observations of a simulated beat: curves, the sensors that they pass through, and the phases by valve events.

A valve is open while its flow exceeds a small share of its peak. Isovolumic contraction lies between the closing of the
mitral valve and the opening of the aortic valve, isovolumic relaxation between the closing of the aortic valve and the
opening of the mitral valve. Filling is divided where its flow has fallen to a third of its early peak, and where it is
least before the atria contract.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import repeat

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.beat import Beat
from heartfit.mechanisms.image_shrinkage import ImageShrinkage
from heartfit.mechanisms.image_smoothing import ImageSmoothing
from heartfit.mechanisms.image_trigger_delay import ImageTriggerDelay
from heartfit.observation.curve import Curve, require_common_phase
from heartfit.observation.operator import CurveFeatures, observe
from heartfit.roles import Sensor

PHASES = (
    "isovolumic contraction",
    "ejection",
    "isovolumic relaxation",
    "early filling",
    "diastasis",
    "atrial systole",
)
OPEN_FLOW_FRACTION = 0.02
"""Flow over its peak above which a valve counts as open."""
DIASTASIS_FLOW_FRACTION = 1.0 / 3.0
"""Flow over its early peak below which early filling has ended."""
EARLY_PEAK_LIMIT, ATRIAL_PEAK_LIMIT = 0.4, 0.6
"""Shares of the duration of filling: the early peak lies before the first, the atrial peak after the second."""
SHRINKAGE_BOUNDS = (-1.0, 0.99)
"""Bounds of the shrinkage in a fit [1]."""
MAX_PERIOD_FRACTION = 0.25
"""Largest delay and smoothing that a fit admits, over the period."""
INITIAL_SMOOTHING = 0.02
"""Smoothing [s] from which a fit starts: at zero the curve does not depend on it to first order."""


def apply_sensors(curves: Mapping[str, Curve], sensors: Sequence[Sensor]) -> dict[str, Curve]:
    """Return the curves, time zero at the trigger, as the sensors show them; unmeasured curves stay unchanged."""
    return {
        name: _distort(curve, [sensor for sensor in sensors if name in sensor.measures])
        for name, curve in curves.items()
    }


def _distort(curve: Curve, sensors: Sequence[Sensor]) -> Curve:
    values = curve.values
    for sensor in sensors:
        values = sensor.distort(curve.times, values, curve.period)
    return replace(curve, values=values)


def image_sensors(shrinkage: float, smoothing: float, delay: float) -> tuple[Sensor, ...]:
    """Return scanner, then registration, which takes the blurred and late first frame as its reference."""
    return ImageSmoothing(smoothing), ImageTriggerDelay(delay), ImageShrinkage(shrinkage)


def fit_sensors(true: Curve, registered: Curve) -> dict[str, float]:
    """Fit the parameters of `image_sensors`, by name [SI], that carry the true volume curve to the registered one.

    Least squares over the samples of `registered`, bounded to |delay|, smoothing <= a quarter of the period.
    true: equidistant samples over its period (InputError otherwise), best much finer than the registered ones or at
    the same times, because it is interpolated linearly. Raises ValueError if the periods differ by more than a tenth.
    """
    from scipy.optimize import least_squares

    require_common_phase(true, registered)
    stroke, longest = np.ptp(true.values), MAX_PERIOD_FRACTION * true.period

    def misfit(parameters: np.ndarray) -> np.ndarray:
        shown = _distort(true, image_sensors(*parameters))
        return (shown(registered.times) - registered.values) / stroke

    low, high = np.array([SHRINKAGE_BOUNDS, (0.0, longest), (-longest, longest)]).T
    fit = least_squares(
        misfit,
        (0.0, INITIAL_SMOOTHING, 0.0),
        bounds=(low, high),
        x_scale=(0.1, INITIAL_SMOOTHING, INITIAL_SMOOTHING),
        xtol=1e-10,
    )
    return dict(zip(("shrinkage", "smoothing", "delay"), fit.x.tolist(), strict=True))


def beat_curves(beat: Beat, sensors: Sequence[Sensor] = ()) -> dict[str, Curve]:
    """Return volumes, pressures and flows ("lv_volume", "aorta_pressure", "mitral_flow", ...) of a beat by name.

    Time zero is the trigger; the curves are those that the sensors show. A failed beat has none.
    """
    if not beat.completed:
        return {}
    inside = beat.time < beat.time[0] + beat.period * (1 - 1e-9)  # the last sample may repeat the first
    curves = {
        name: Curve(beat.time[inside], values[inside], beat.period).shifted(beat.trigger)
        for name, values in beat.signals().items()
    }
    return apply_sensors(curves, sensors)


def observe_beats(
    beats: Iterable[Beat],
    features: Mapping[str, CurveFeatures],
    sensors: Iterable[Sequence[Sensor]] | None = None,
) -> list[dict[str, float] | str]:
    """Observe every beat: its observations by name, or the reason of its failure, as the calibration takes them.

    sensors: one sequence for each beat, because a sensor's parameters may differ from beat to beat; no sensors if None.
    """
    pairs = zip(beats, repeat(()), strict=False) if sensors is None else zip(beats, sensors, strict=True)
    return [
        observe(beat_curves(beat, beat_sensors), features) if beat.completed else beat.reason
        for beat, beat_sensors in pairs
    ]


@dataclass(frozen=True, eq=False)
class BeatPhases:
    """Starts (6,) of PHASES [s] after the trigger, within the period [s]."""

    starts: Floats
    period: float

    @classmethod
    def from_curves(cls, curves: Mapping[str, Curve]) -> "BeatPhases":
        """Find the phases from "aortic_flow" and "mitral_flow"; ValueError for a valve that never opens or closes."""
        aortic, mitral_flow = curves["aortic_flow"], curves["mitral_flow"]
        ejection, filling = _open_samples(aortic, mitral_flow), _open_samples(mitral_flow, aortic)
        mitral = filling.values
        early = int(mitral[: max(1, int(EARLY_PEAK_LIMIT * len(mitral)))].argmax())
        kick = int(ATRIAL_PEAK_LIMIT * len(mitral)) + int(
            mitral[int(ATRIAL_PEAK_LIMIT * len(mitral)) :].argmax()
        )
        atrial = early + int(mitral[early : kick + 1].argmin())
        slow = early + int(np.argmax(mitral[early : atrial + 1] <= DIASTASIS_FLOW_FRACTION * mitral[early]))
        diastasis = slow if mitral[slow] <= DIASTASIS_FLOW_FRACTION * mitral[early] else atrial
        times = [
            filling.times[-1],
            ejection.times[0],
            ejection.times[-1],
            filling.times[0],
            filling.times[diastasis],
            filling.times[atrial],
        ]
        return cls(np.mod(times, filling.period), filling.period)

    def names_at(self, times: Floats) -> list[str]:
        """Return the name of the phase at each of the times [s] after the trigger."""
        since = np.mod(np.asarray(times)[:, None] - self.starts, self.period)
        return [PHASES[index] for index in since.argmin(axis=1)]

    def spans(self) -> list[tuple[str, float, float]]:
        """Return (name, start, end) [s] after the trigger, sorted; a phase that wraps around the period is split."""
        ends = np.roll(self.starts, -1)
        parts: list[tuple[str, float, float]] = []
        for name, start, end in zip(PHASES, self.starts.tolist(), ends.tolist(), strict=True):
            whole = [(start, end)] if start <= end else [(start, self.period), (0.0, end)]
            parts += [(name, first, last) for first, last in whole]
        return sorted(parts, key=lambda part: part[1])


def _open_samples(flow: Curve, other: Curve) -> Curve:
    """Return the samples from the first opening of a valve to its last closing between two peaks of the ``other`` flow.

    Blood that flows back in diastasis closes the mitral valve within its filling. The times increase from the opening
    on and may exceed the period.
    """
    is_open = flow.values > OPEN_FLOW_FRACTION * flow.values.max()
    if is_open.all() or not is_open.any():
        raise ValueError("phases of the beat: a valve never opens or never closes")
    peak = int(other.values.argmax())
    opening = int(np.flatnonzero(np.roll(is_open & ~np.roll(is_open, 1), -peak))[0] + peak) % is_open.size
    unrolled = Curve(_unrolled_times(flow, opening), np.roll(flow.values, -opening), flow.period)
    until = (peak - opening) % is_open.size or is_open.size
    last = int(np.flatnonzero(np.roll(is_open, -opening)[:until])[-1]) + 2
    return Curve(unrolled.times[:last], unrolled.values[:last], flow.period)


def _unrolled_times(flow: Curve, first: int) -> Floats:
    """Return the times from sample ``first`` on, increasing over one period."""
    times: Floats = np.concatenate([flow.times[first:], flow.times[:first] + flow.period])
    return times
