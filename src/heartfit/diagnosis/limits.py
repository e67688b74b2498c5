"""How large each effect of the library must be to show in a volume and a pressure: see :mod:`heartfit.discovery.limit`.

The hearts are the average one and others drawn from the priors; each is recorded as a study would.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.diagnosis.centre import HUMAN, Centre
from heartfit.diagnosis.library import BASE, Candidate, candidates, hypothesis
from heartfit.diagnosis.record import data_of
from heartfit.diagnosis.recording import Recording, Samples
from heartfit.diagnosis.twin import NUMERICS, Twin
from heartfit.discovery.limit import crossing, expected
from heartfit.discovery.rules import RULES
from heartfit.geometry.arrays import Floats
from heartfit.parameter import Parameter

SIZES = (1.0, 2.0, 3.0, 4.0)
"""In scales."""
FRAMES, RATE = 28, 1000.0
"""Of the volume; samples of pressure, 1/s."""


@dataclass(frozen=True)
class Limit:
    """What an effect is expected to show: median ln Bayes factors over the hearts at each of ``SIZES``.

    sign: of the amplitude; least: the detection limit in scales, None beyond the largest size.
    """

    name: str
    switch: Parameter
    sign: float
    factors: tuple[float, ...]
    least: float | None

    @property
    def amplitude(self) -> float | None:
        """The detection limit, SI."""
        return None if self.least is None else self.switch.at(self.sign * self.least)


def limits(
    hearts: int, centre: Centre = HUMAN, names: Sequence[str] = (), threshold: float = RULES.detected
) -> Iterator[Limit]:
    """The limits of all mechanisms, or of those named; both signs of an effect that has two."""
    data = data_of(_recorded(centre))
    twin = Twin(centre, {block.curve: block.times for block in data.blocks})
    drawn = [np.zeros(len(BASE)), *np.random.default_rng(0).standard_normal((hearts - 1, len(BASE)))]

    def factor(candidate: Candidate, heart: Floats, amplitude: float) -> float:
        x = np.concatenate([heart, [amplitude], np.zeros(len(candidate.unknowns) - 1)])
        found = expected(hypothesis(twin), hypothesis(twin, (candidate,)), data.blocks, x)
        return np.nan if found is None else found

    for name, candidate in _among(candidates(twin), names).items():
        switch = candidate.unknowns[0]
        for sign in (1.0,) if switch.one_sided else (1.0, -1.0):
            seen = [[factor(candidate, heart, sign * size) for size in SIZES] for heart in drawn]
            factors = tuple(np.nanmedian(seen, axis=0).tolist())
            yield Limit(name, switch, sign, factors, crossing(SIZES, factors, threshold))


def _among(library: Mapping[str, Candidate], names: Sequence[str]) -> dict[str, Candidate]:
    return {name: each for name, each in library.items() if not names or name in names}


def _recorded(centre: Centre) -> Recording:
    """The times of a study's frames and of its catheter, with the values of the centre's beat."""
    beat, period = centre.beat(NUMERICS), centre.heart.period
    times = {
        "lv_volume": np.arange(FRAMES) * period / FRAMES,
        "lv_pressure": np.arange(int(period * RATE)) / RATE,
    }
    curves = {name: np.interp(at, beat.time, beat.signals()[name]) for name, at in times.items()}
    return Recording(period, {name: Samples(times[name], values) for name, values in curves.items()})
