"""Averaged pressure beat from a recording of several beats.

The recording is cut at its triggers or, where none were recorded, at the steepest rise of each beat. Beats of unusual
length (an ectopic beat and the pause after it) are left out, then those whose curve is far from the median beat. The
rest is averaged over the relative time in the beat, as the slices of a cine are.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.observation.curve import Curve, require_pressures

MIN_SAMPLING_RATE = 50.0
"""Lowest sampling rate [1/s] from which peak rates of pressure can be taken."""
MIN_SAMPLE_STEP = 1e-3
"""Smallest step [s] between samples of the averaged beat."""
MIN_BEAT_LENGTH = 0.25
"""Shortest time [s] between two beats."""
LENGTH_TOLERANCE, FORM_TOLERANCE = 0.15, 3.0
"""Largest deviation from the median length [1], and RMS distance from the median beat over its median [1]."""
PERIOD_TOLERANCE = 0.1
"""Largest relative difference between the median length of the beats and the period of the images."""
MAX_SINGLE_BEAT_SPAN = 1.5
"""Span of a trace, in periods, below which it counts as one beat."""
SEARCH_WINDOW, PEAK_FRACTION = 0.1, 0.95
"""Window [s] about a crossing in which the steepest rise or peak is sought; share of a peak that counts as near it."""


@dataclass(frozen=True, eq=False)
class PressureTrace:
    """Pressures (k,) [Pa] at increasing times (k,) [s], with the ECG or marker (k,) as trigger where it was recorded.

    Raises InputError for implausible pressures, times that do not increase and steps longer than 20 ms.
    """

    times: Floats
    pressures: Floats
    trigger: Floats | None = None

    def __post_init__(self) -> None:
        if self.times.size < 2 or not np.isfinite([*self.times, *self.pressures]).all():
            raise InputError("fewer than two samples, or some that are not finite; drop these rows")
        steps = np.diff(self.times)
        if (steps <= 0.0).any():
            row = int(np.argmax(steps <= 0.0))
            raise InputError(
                f"time goes from {self.times[row]:g} s to {self.times[row + 1]:g} s; expected increasing times: sort "
                "the rows"
            )
        if steps.max() > 1.0 / MIN_SAMPLING_RATE:
            row = int(np.argmax(steps))
            raise InputError(
                f"{steps.max():g} s from {self.times[row]:g} s to the next sample; "
                f"expected at most {1 / MIN_SAMPLING_RATE:g} s, as peak rates need: check the unit of time"
            )
        require_pressures(self.pressures)

    @property
    def span(self) -> float:
        """Time [s] from the first sample to the end of the last one."""
        return float(np.ptp(self.times)) + 1.0 / self.rate

    @property
    def rate(self) -> float:
        """Mean sampling rate [1/s]."""
        return (self.times.size - 1) / float(np.ptp(self.times))


@dataclass(frozen=True, eq=False)
class AveragedPressure:
    """Mean beat over one period from the trigger; beats (b, k) [Pa]: all beats at its times; kept (b,): mask."""

    curve: Curve
    beats: Floats
    kept: np.ndarray

    @property
    def end_diastolic(self) -> float:
        """Pressure at the trigger [Pa]."""
        return float(self.curve(0.0))


def average_beats(
    trace: PressureTrace, period: float, upstroke: float | None = None, delay: float = 0.0
) -> AveragedPressure:
    """Average the beats of a trace, stretched to the `period` [s] of the images.

    upstroke: time [s] after the trigger at which the pressure rises fastest, for a trace without trigger; a trace of
    one beat begins at its trigger. delay: lag [s] of the pressure behind the trigger signal. Raises InputError
    for beats whose length is not that of the images, and if neither trigger nor upstroke marks where beats begin.
    """
    starts = _beat_starts(trace, period, upstroke)
    lengths = np.diff(starts)
    usual = float(np.median(lengths))
    if abs(usual / period - 1.0) > PERIOD_TOLERANCE:
        raise InputError(
            f"the beats are {usual:.3f} s long, those of the images {period:.3f} s; expected the same to "
            f"{100 * PERIOD_TOLERANCE:g} %: take a recording at the heart rate of the images"
        )
    count = round(period * min(1.0 / MIN_SAMPLE_STEP, trace.rate))
    places = starts[:-1, None] + delay + np.arange(count) / count * lengths[:, None]
    wrap = trace.span if lengths.size == 1 else None
    beats = np.interp(places, trace.times, trace.pressures, period=wrap)
    kept = _usual_beats(beats, lengths, usual)
    times = np.arange(count) * period / count
    return AveragedPressure(Curve.of_pressure(times, beats[kept].mean(axis=0), period), beats, kept)


def _beat_starts(trace: PressureTrace, period: float, upstroke: float | None) -> Floats:
    """Times [s] at which the beats begin, and the last one ends."""
    first, last = trace.times[0], trace.times[0] + trace.span
    if trace.trigger is not None:
        starts, events = _peak_times(trace.times, trace.trigger), "triggers"
    elif upstroke is not None:
        starts, events = _steepest_rises(trace) - upstroke, "rises of the pressure"
    elif trace.span < MAX_SINGLE_BEAT_SPAN * period:
        return np.array([first, last])
    else:
        raise InputError(
            f"{trace.span / period:.0f} beats, and neither trigger nor upstroke marks where they begin; "
            "expected the column of the ECG or of a marker as trigger, or as upstroke the time from the trigger to the "
            "fastest rise of the pressure"
        )
    inside = starts[(starts >= first) & (starts <= last)]
    if inside.size < 2:
        raise InputError(
            f"{inside.size} {events} in {trace.span:.2f} s; expected at least two, a whole beat: check column and unit"
        )
    return inside


def _peak_times(times: Floats, signal: Floats) -> Floats:
    """Times at which the signal first comes near each of its peaks: R wave of an ECG, step of a marker."""
    peaks = []
    for time in _upward_crossings(times, signal, _trigger_level(signal)):
        near = np.flatnonzero((times >= time) & (times < time + SEARCH_WINDOW))
        peaks.append(times[near[np.argmax(signal[near] > PEAK_FRACTION * signal[near].max())]])
    return np.array(peaks)


def _trigger_level(signal: Floats) -> float:
    low, high = np.percentile(signal, 50.0), signal.max()
    if not high > low:
        raise InputError("the trigger never rises; expected an ECG, or a marker that steps up at each beat")
    return float(0.5 * (low + high))


def _upward_crossings(times: Floats, signal: Floats, level: float) -> Floats:
    """Times at which the signal crosses the level upwards, the first of each beat, linear between samples."""
    below = np.flatnonzero((signal[:-1] <= level) & (signal[1:] > level))
    share = (level - signal[below]) / (signal[below + 1] - signal[below])
    kept: list[float] = []
    for time in times[below] + share * (times[below + 1] - times[below]):
        if not kept or time - kept[-1] > MIN_BEAT_LENGTH:
            kept.append(float(time))
    return np.array(kept)


def _steepest_rises(trace: PressureTrace) -> Floats:
    """Times of the fastest rise in each beat: its crossing of the middle plus the median delay over the beats.

    The crossing is accurate to a fraction of a sample, the steepest rise of one noisy beat is not.
    """
    low, high = np.percentile(trace.pressures, (10.0, 95.0))
    crossings = _upward_crossings(trace.times, trace.pressures, 0.5 * (low + high))
    if not crossings.size:
        return crossings
    slopes = np.gradient(trace.pressures, trace.times)
    near = [np.flatnonzero(np.abs(trace.times - time) < SEARCH_WINDOW) for time in crossings]
    steepest = np.array([trace.times[window[slopes[window].argmax()]] for window in near])
    return crossings + float(np.median(steepest - crossings))


def _usual_beats(beats: Floats, lengths: Floats, usual: float) -> np.ndarray:
    """Mask (b,) of the beats of usual length and form."""
    kept = np.abs(lengths / usual - 1.0) < LENGTH_TOLERANCE
    away = np.sqrt(np.mean((beats - np.median(beats[kept], axis=0)) ** 2, axis=1))
    usual_form: np.ndarray = kept & (away <= FORM_TOLERANCE * max(float(np.median(away[kept])), 1.0))
    return usual_form
