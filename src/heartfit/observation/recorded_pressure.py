"""One beat of pressure from a recording of several.

The recording is cut at its triggers or, where none were recorded, at the steepest rise of each beat. Beats whose length
is not the usual one (an ectopic beat and the pause after it) are left out, then those whose curve is far from the
others'. The rest is averaged by the share of the beat that has passed, as the slices of a cine are.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import Curve, require_pressures

SLOWEST = 50.0
"""Samples a second: with fewer, peak rates of pressure mean nothing."""
FINEST = 1e-3
"""s between samples of the averaged beat, at least."""
SHORTEST = 0.25
"""s between two beats."""
UNUSUAL_LENGTH, UNUSUAL_FORM = 0.15, 3.0
"""Of a beat: relative to the median length; its RMS distance from the median beat over the median of these."""
OTHER_RATE = 0.1
"""Relative difference of the beats' lengths from the images' beat beyond which the two are not of one state."""
FEWER_THAN_TWO = 1.5
"""Beats in a trace that is taken for one."""
RISE, NEAR_PEAK = 0.1, 0.95
"""s about a crossing of the middle in which the steepest rise or the peak is looked for; what is near it, of a peak."""


@dataclass(frozen=True, eq=False)
class PressureTrace:
    """Pressures (k,), Pa, at increasing times (k,), s, and the ECG or marker (k,) where there is one.

    Raises InputError for pressures that no human has, times that do not increase and samples more than 20 ms apart.
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
        if steps.max() > 1.0 / SLOWEST:
            row = int(np.argmax(steps))
            raise InputError(
                f"{steps.max():g} s from {self.times[row]:g} s to the next sample; expected at most {1 / SLOWEST:g} s: "
                "peak rates of pressure mean nothing with less; is the unit of time right?"
            )
        require_pressures(self.pressures)

    @property
    def span(self) -> float:
        """s from the first sample to the end of the last one."""
        return float(np.ptp(self.times)) + 1.0 / self.rate

    @property
    def rate(self) -> float:
        """Samples a second."""
        return (self.times.size - 1) / float(np.ptp(self.times))


@dataclass(frozen=True, eq=False)
class AveragedPressure:
    """The mean beat, from the trigger, over one period; beats (b, k) Pa of all beats at its times, kept (b,)."""

    curve: Curve
    beats: Floats
    kept: np.ndarray

    @property
    def end_diastolic(self) -> float:
        """The pressure at the trigger, Pa."""
        return float(self.curve(0.0))


def average_beats(
    trace: PressureTrace, period: float, upstroke: float | None = None, delay: float = 0.0
) -> AveragedPressure:
    """The mean beat, stretched to the images' `period`, s.

    upstroke: s after the trigger at which the pressure rises fastest, where the trace has no trigger; a trace of one
    beat begins at its trigger. delay: s by which the pressure is later than the trigger's signal. Raises InputError
    for beats of another length than the images', and where nothing says when a beat begins.
    """
    starts = _starts(trace, period, upstroke)
    lengths = np.diff(starts)
    usual = float(np.median(lengths))
    if abs(usual / period - 1.0) > OTHER_RATE:
        raise InputError(
            f"the beats are {usual:.3f} s long, those of the images {period:.3f} s; expected the same to "
            f"{100 * OTHER_RATE:g} %: take a recording at the heart rate of the images"
        )
    count = round(period * min(1.0 / FINEST, trace.rate))
    places = starts[:-1, None] + delay + np.arange(count) / count * lengths[:, None]
    wrap = trace.span if lengths.size == 1 else None
    beats = np.interp(places, trace.times, trace.pressures, period=wrap)
    kept = _usual(beats, lengths, usual)
    times = np.arange(count) * period / count
    return AveragedPressure(Curve.of_pressure(times, beats[kept].mean(axis=0), period), beats, kept)


def _starts(trace: PressureTrace, period: float, upstroke: float | None) -> Floats:
    """When the beats begin, s, and the last one ends."""
    first, last = trace.times[0], trace.times[0] + trace.span
    if trace.trigger is not None:
        starts, what = _peaks(trace.times, trace.trigger), "triggers"
    elif upstroke is not None:
        starts, what = _steepest(trace) - upstroke, "rises of the pressure"
    elif trace.span < FEWER_THAN_TWO * period:
        return np.array([first, last])
    else:
        raise InputError(
            f"{trace.span / period:.0f} beats, and nothing says when one begins; expected the column of the ECG or of "
            "a marker as trigger, or as upstroke how long after the trigger the pressure rises fastest"
        )
    inside = starts[(starts >= first) & (starts <= last)]
    if inside.size < 2:
        raise InputError(
            f"{inside.size} {what} in {trace.span:.2f} s; expected at least two, a whole beat: check column and unit"
        )
    return inside


def _peaks(times: Floats, signal: Floats) -> Floats:
    """When the signal is first near each of its peaks: the R wave of an ECG, the step of a marker."""
    peaks = []
    for time in _rises(times, signal, _halfway(signal)):
        near = np.flatnonzero((times >= time) & (times < time + RISE))
        peaks.append(times[near[np.argmax(signal[near] > NEAR_PEAK * signal[near].max())]])
    return np.array(peaks)


def _halfway(signal: Floats) -> float:
    low, high = np.percentile(signal, 50.0), signal.max()
    if not high > low:
        raise InputError("the trigger never rises; expected an ECG, or a marker that steps up at each beat")
    return float(0.5 * (low + high))


def _rises(times: Floats, signal: Floats, level: float) -> Floats:
    """Times at which the signal crosses the level upwards, the first of each beat, linear between samples."""
    below = np.flatnonzero((signal[:-1] <= level) & (signal[1:] > level))
    share = (level - signal[below]) / (signal[below + 1] - signal[below])
    kept: list[float] = []
    for time in times[below] + share * (times[below + 1] - times[below]):
        if not kept or time - kept[-1] > SHORTEST:
            kept.append(float(time))
    return np.array(kept)


def _steepest(trace: PressureTrace) -> Floats:
    """When the pressure rises fastest in each beat: as long after it crosses its middle as in the median beat.

    The crossing is found to a fraction of a sample, the steepest rise of one noisy beat is not.
    """
    low, high = np.percentile(trace.pressures, (10.0, 95.0))
    crossings = _rises(trace.times, trace.pressures, 0.5 * (low + high))
    if not crossings.size:
        return crossings
    slopes = np.gradient(trace.pressures, trace.times)
    near = [np.flatnonzero(np.abs(trace.times - time) < RISE) for time in crossings]
    steepest = np.array([trace.times[each[slopes[each].argmax()]] for each in near])
    return crossings + float(np.median(steepest - crossings))


def _usual(beats: Floats, lengths: Floats, usual: float) -> np.ndarray:
    """The beats of usual length and form."""
    kept = np.abs(lengths / usual - 1.0) < UNUSUAL_LENGTH
    away = np.sqrt(np.mean((beats - np.median(beats[kept], axis=0)) ** 2, axis=1))
    usual_form: np.ndarray = kept & (away <= UNUSUAL_FORM * max(float(np.median(away[kept])), 1.0))
    return usual_form
