"""The sphere that stands for a heart in the search: from standardised coordinates to what would be recorded."""

from collections import OrderedDict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import reduce
from operator import add

import numpy as np

from heartfit.beat import Beat
from heartfit.diagnosis.centre import Centre
from heartfit.diagnosis.free import FREE, UNFELT, moved
from heartfit.geometry.arrays import Floats
from heartfit.heart import Heart
from heartfit.mechanism import Mechanism, Sensor
from heartfit.simulation import Numerics

NUMERICS = Numerics(time_step=5e-3, max_beats=30, drift=1e-5)
"""Finite differences ask for a limit cycle: at a drift of 1 % beats differ by 1 mL and 0.3 kPa from it, here by 0.1 mL
and 0.02 kPa at most."""

REMEMBERED = 256
"""Beats kept for hypotheses that differ by an instrument only, which the heart does not feel."""


@dataclass(eq=False)
class Twin:
    """Predicts curves at their ``times`` by name, s after the trigger.

    ``simulations`` counts the beats that were run: an instrument costs none.
    """

    centre: Centre
    times: Mapping[str, Floats]
    simulations: int = 0
    _beats: "OrderedDict[bytes, Beat]" = field(default_factory=OrderedDict)

    def predicted(self, x: Floats, effects: Sequence[Mechanism]) -> Floats | None:
        """The curves (n,), one after the other, SI, at the coordinates x (23,); None where no beat is reached."""
        reached = self.reached(x, effects)
        if reached is None:
            return None
        heart, beat = reached
        return np.concatenate([shown(beat, heart, name, at) for name, at in self.times.items()])

    def reached(self, x: Floats, effects: Sequence[Mechanism] = ()) -> tuple[Heart, Beat] | None:
        """The heart at the coordinates x (23,) and its beat; None where there is none."""
        try:
            centre = moved(self.centre, x)
            heart = reduce(add, effects, centre.heart)
            beat = self._beat(replace(centre, heart=heart), x, effects)
        except ValueError:  # coordinates beyond what a heart can be
            return None
        return (heart, beat) if beat.completed and beat.volume["lv"].min() > 0.0 else None

    def _beat(self, centre: Centre, x: Floats, effects: Sequence[Mechanism]) -> Beat:
        felt = [each for each in effects if not isinstance(each, Sensor)]
        key = np.delete(x[: len(FREE)], UNFELT).tobytes() + repr(felt).encode()
        beat = self._beats.pop(key, None)
        if beat is None:
            self.simulations += 1
            beat = centre.beat(NUMERICS)
        self._beats[key] = beat
        if len(self._beats) > REMEMBERED:
            self._beats.popitem(last=False)
        return beat


def shown(beat: Beat, heart: Heart, name: str, times: Floats) -> Floats:
    """What the instruments of the heart show of a curve at ``times`` (k,), s after the trigger, SI."""
    start, values = beat.time[:-1] - heart.trigger, beat.signals()[name][:-1]
    for sensor in heart.sensors:
        if name in sensor.measures:
            values = sensor.distort(start, values, beat.period)
    return smooth(np.mod(times - start[0], beat.period) / beat.period, values)


def smooth(phases: Floats, values: Floats) -> Floats:
    """A curve of equidistant samples (m,) of one period at ``phases`` (k,), 0 <= phase < 1.

    Cubic with the slopes of central differences: between straight lines the slopes that a search takes of a delay would
    jump at every sample.
    """
    count = values.size
    index = np.floor(phases * count).astype(np.int64)
    u = phases * count - index
    left, right = values[index % count], values[(index + 1) % count]
    before, after = values[(index - 1) % count], values[(index + 2) % count]
    bend = u * (2.0 * before - 5.0 * left + 4.0 * right - after + u * (3.0 * (left - right) + after - before))
    return left + 0.5 * u * (right - before + bend)
