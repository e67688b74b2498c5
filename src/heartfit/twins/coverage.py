"""How often the intervals of a calibration hold the truth, over hearts drawn from the prior."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np

from heartfit.calibration.design import CalibrationError
from heartfit.calibration.fixed import covariance_of_fixed
from heartfit.calibration.forward import Forward, Remembered
from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.iterated import iterated
from heartfit.cohort.hidden_heart import OTHER_SPREAD
from heartfit.geometry.arrays import Floats
from heartfit.observation.coverage import Share
from heartfit.twins.draw import WORLDS, Twin, Twins, World

REACH = 1.959964
"""Standard deviations of a Gaussian's interval of 95 %."""
STEPS = 2


@dataclass(frozen=True, eq=False)
class Coverage:
    """Errors of the estimates (hearts, n) in standard deviations of their posteriors, of one way in one world.

    A heart whose calibration failed is a row of NaN: it is not covered.
    """

    world: str
    way: str
    names: tuple[str, ...]
    scores: Floats

    def shares(self) -> dict[str, Share]:
        """Share of the hearts whose truth is in the 95 % interval, by parameter."""
        held = np.abs(self.scores) <= REACH
        return {
            name: Share.of(float(column.sum()), len(column))
            for name, column in zip(self.names, held.T, strict=True)
        }

    def pooled(self) -> Share:
        """Share of all parameters of all hearts; those of one heart err together, so it counts hearts as trials."""
        held = np.abs(self.scores) <= REACH
        return Share.of(float(held.mean() * len(held)), len(held))


def cover(twins: Twins, hearts: int) -> list[Coverage]:
    """One step under each noise in each world; where other parameters are unknown, two steps too."""
    forward, spare = Remembered(twins.model), fixed_noise(twins)
    return [coverage for world in WORLDS for coverage in _of_world(twins, forward, spare, hearts, world)]


def _of_world(twins: Twins, forward: Forward, spare: Floats, hearts: int, world: World) -> Iterator[Coverage]:
    drawn = [twins.draw(number, world) for number in range(hearts)]
    ways: dict[str, tuple[Callable[[Twin], Floats | None], int]] = {
        "R = 0": (lambda _: None, 1),
        "R of the measurement": (lambda twin: twin.noise, 1),
        "R and R_fixed": (lambda twin: twin.noise + spare, 1),
    }
    if world == "parameters":
        ways[f"R and R_fixed, {STEPS} steps"] = (lambda twin: twin.noise + spare, STEPS)
    for way, (noise, steps) in ways.items():
        scores = [_scores(twins.prior, forward, twin, noise(twin), steps) for twin in drawn]
        yield Coverage(world, way, twins.prior.names, np.array(scores))


def fixed_noise(twins: Twins) -> Floats:
    """R_fixed (m, m) of the parameters that scatter though nobody estimates them, by slopes at the prior's mean."""
    sds = np.full(len(twins.fixed), OTHER_SPREAD)
    return covariance_of_fixed(twins.model.slopes(twins.fixed, tuple(twins.noise), OTHER_SPREAD), sds)


def _scores(prior: Gaussian, forward: Forward, twin: Twin, noise: Floats | None, steps: int) -> Floats:
    try:
        *_, last = islice(iterated(prior, forward, twin.observed, noise), steps)
    except CalibrationError:
        return np.full(len(prior.names), np.nan)
    return (last.estimate.mean - twin.truth) / last.estimate.sd
