"""Consistency of a recorded volume and pressure: curves of one beat, which together do the work of a ventricle.

Curves of different beats, rates, triggers or units are the most usual fault of recordings. Each check compares one
number of the two curves with the range of living ventricles, from the failing to the exercising heart:

- ejection fraction, peak pressure, and peak rate of the pressure;
- stroke work, the area of the loop of pressure over volume, W = -∮ p dV, positive for a counter-clockwise loop;
- lag: the shift of the pressure at which W is largest. Blood leaves at high pressure and enters at low pressure, so
  aligned curves do nearly the largest work that any shift of them does;
- the volume that moves while the pressure rises, and while it falls: both phases are nearly isovolumic;
- closure: the last sample of a beat meets the first.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.recording import Recording, Samples, averaged_by_phase

PHASES = 100
"""Number of phases of the beat at which both curves are compared."""
EJECTION_FRACTION = (0.10, 0.85)
PEAK_PRESSURE = (6e3, 35e3)
"""[Pa], 45 to 260 mmHg."""
PEAK_RATE = (3e4, 7e5)
"""Largest rate of the pressure [Pa/s], 230 to 5300 mmHg/s."""
FINE_SAMPLING = 0.012
"""Longest time [s] between samples that show the largest rate of a pressure."""
STROKE_WORK = (0.05, 3.5)
"""[J]; a healthy heart at rest does about one joule."""
LEAST_SHARE_OF_WORK = 0.7
"""Least work over that of the best shift of the pressure; healthy hearts of another simulator, which empty early, have
0.75 to 0.98."""
LONGEST_LAG = 0.25
"""Largest shift that is tried, over the period."""
MOST_VOLUME = 0.4
"""Largest part of the stroke volume that moves between LOW and HIGH of the pressure's range."""
LOW, HIGH = 0.2, 0.7
"""Part of the pressure's range at which its rise begins and ends; its fall, in reverse."""
LARGEST_GAP = 0.25
"""Largest difference between the ends of a beat, over the range of the curve."""
WHOLE_BEAT = 0.95
"""Part of the period that samples must span to show whether a beat closes."""


@dataclass(frozen=True)
class Loop:
    """Volume [m^3] and pressure [Pa] at PHASES equidistant times of a beat of the period [s]."""

    volume: Floats
    pressure: Floats
    period: float

    def work(self, lag: int = 0) -> float:
        """Return the work [J] of one round with the pressure taken earlier by so many phases."""
        change = 0.5 * (np.roll(self.volume, -1) - np.roll(self.volume, 1))
        return -float(np.roll(self.pressure, -lag) @ change)

    def lag(self) -> int:
        """Return the delay of the pressure, in phases: the one whose removal gives the largest work."""
        longest = round(LONGEST_LAG * PHASES)
        return max(range(-longest, longest + 1), key=self.work)

    def volume_moved(self, rising: bool) -> float:
        """Return the part of the stroke volume that moves while the pressure rises, or falls, past its middle range."""
        share = (self.pressure - self.pressure.min()) / np.ptp(self.pressure)
        step = 1 if rising else -1
        middle = self._steepest(share, step)
        begin = next((k for k in range(PHASES) if share[(middle - step * k) % PHASES] <= LOW), 0)
        end = next((k for k in range(PHASES) if share[(middle + step * k) % PHASES] >= HIGH), 0)
        places = (middle + step * np.arange(-begin, end + 1)) % PHASES
        return float(np.ptp(self.volume[places]) / np.ptp(self.volume))

    @staticmethod
    def _steepest(share: Floats, step: int) -> int:
        return int(np.argmax(np.roll(share, -step) - np.roll(share, step)))


def folded(samples: Samples, period: float, phases: int = PHASES) -> Floats:
    """Return the values at equidistant phases, averaged over all beats and linear between samples."""
    means = averaged_by_phase(samples, period, period / phases)
    grid = np.arange(phases) * period / phases
    return np.asarray(np.interp(grid, means.times, means.values, period=period))


def implausible(recording: Recording, name: str = "recording") -> tuple[str, ...]:
    """Return one line for each number of the recording outside the range of living ventricles.

    name: of the recording in messages. Raises InputError for a loop that runs clockwise: such a ventricle would be
    driven by its blood.
    """
    volume = folded(recording.curves["lv_volume"], recording.period)
    lines = [
        *_outside("ejection fraction", np.ptp(volume) / volume.max(), EJECTION_FRACTION, 1e2, "%"),
        *(line for curve in recording.searched for line in _open(curve, recording)),
    ]
    if "lv_pressure" not in recording.curves:
        return tuple(lines)
    samples = recording.curves["lv_pressure"]
    loop = Loop(volume, folded(samples, recording.period), recording.period)
    if loop.work() <= 0.0:
        raise InputError(
            f"{name}: the loop of pressure and volume runs clockwise ({loop.work():.2f} J a beat); expected "
            f"counter-clockwise, as blood leaves at high pressure: the pressure lags by {_milliseconds(loop)} ms, or "
            "the curves belong to different beats"
        )
    return (*lines, *_of_pressure(samples, loop), *_of_both(loop))


def _of_pressure(samples: Samples, loop: Loop) -> Iterator[str]:
    yield from _outside("peak pressure", loop.pressure.max(), PEAK_PRESSURE, 1e-3, "kPa")
    if np.median(np.diff(samples.times)) <= FINE_SAMPLING:
        rate = np.max(np.diff(loop.pressure, append=loop.pressure[0])) * PHASES / loop.period
        yield from _outside("largest rate of the pressure", rate, PEAK_RATE, 1e-3, "kPa/s")


def _of_both(loop: Loop) -> Iterator[str]:
    yield from _outside("stroke work", loop.work(), STROKE_WORK, 1.0, "J")
    share = loop.work() / loop.work(loop.lag())
    if share < LEAST_SHARE_OF_WORK:
        yield (
            f"the pressure seems {_milliseconds(loop)} ms late: the loop does {100 * share:.0f} % of the work that it "
            "does without this lag; check the triggers, and that both curves are of one heart rate"
        )
    for rising, phase in ((True, "rises"), (False, "falls")):
        volume = loop.volume_moved(rising)
        if volume > MOST_VOLUME:
            yield (
                f"{100 * volume:.0f} % of the stroke volume moves while the pressure {phase}, expected at most "
                f"{100 * MOST_VOLUME:.0f} %, because the valves are closed: check the triggers"
            )


def _milliseconds(loop: Loop) -> int:
    return round(1e3 * loop.lag() * loop.period / PHASES)


def _outside(name: str, value: float, bounds: tuple[float, float], scale: float, unit: str) -> Iterator[str]:
    if not bounds[0] <= value <= bounds[1]:
        low, high = (f"{scale * bound:g}" for bound in bounds)
        yield f"{name} {scale * value:.3g} {unit}, expected {low} to {high} {unit}: check the unit and the column"


def _open(name: str, recording: Recording) -> Iterator[str]:
    """Yield a line if a recording of one beat does not return to where it began."""
    samples, period = recording.curves[name], recording.period
    span = float(np.ptp(samples.times))
    if not WHOLE_BEAT * period <= span < period:
        return
    gap = abs(samples.values[-1] - samples.values[0]) / np.ptp(samples.values)
    if gap > LARGEST_GAP:
        yield (
            f"{name}: the ends of the beat differ by {100 * gap:.0f} % of its range, expected at most "
            f"{100 * LARGEST_GAP:.0f} %: is the period {period:g} s that of this curve?"
        )
