"""Hearts drawn from the prior, and what is measured of them."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.cohort.hidden_heart import OTHER_MODEL, OTHER_SPREAD, OTHERS, VALVES
from heartfit.geometry.arrays import Floats
from heartfit.heart import Heart
from heartfit.twins.model import SphericalModel

World = Literal["nothing", "parameters", "model"]
"""What the calibrator does not know of a heart beside what it estimates: nothing; the values of other parameters,
which it holds fixed; these and the model itself, as in :mod:`heartfit.cohort.hidden_heart`."""
WORLDS: tuple[World, ...] = get_args(World)
BRANCHES = ("mitral", "aortic", "tricuspid", "pulmonary")


@dataclass(frozen=True, eq=False)
class Twin:
    """A heart of known truth: its logarithms (n,), what was measured of it, and R (m, m) of the measurement."""

    truth: Floats
    observed: Mapping[str, float]
    noise: Floats


@dataclass(frozen=True, eq=False)
class Twins:
    """How hearts are drawn: the calibrator's model and prior, the relative deviation of each observation, a seed.

    All have one shape. What differs is what is estimated, and what the calibrator does not know.
    """

    model: SphericalModel
    prior: Gaussian
    noise: Mapping[str, float]
    seed: int

    @property
    def fixed(self) -> tuple[str, ...]:
        """The parameters that scatter though nobody estimates them."""
        return tuple(name for name in OTHERS if name not in self.prior.names)

    def draw(self, number: int, world: World) -> Twin:
        """Heart ``number``, with the same deviates in every world; one that does not beat is drawn anew."""
        rng = np.random.default_rng([self.seed, number])
        n, others, m = len(self.prior.names), len(self.fixed), len(self.noise)
        while True:
            mine, theirs, error = np.split(rng.standard_normal(n + others + m), [n, n + others])
            truth = self.prior.mean + np.linalg.cholesky(self.prior.covariance) @ mine
            outcome = self.model.observed(self._heart(truth, theirs, world))
            if not isinstance(outcome, str):
                return self._measured(truth, outcome, error)

    def _heart(self, truth: Floats, deviates: Floats, world: World) -> Heart:
        heart = self.model.heart.with_parameters(self.prior.physical(truth))
        if world == "nothing":
            return heart
        values = heart.parameters()
        ratios = zip(self.fixed, np.exp(OTHER_SPREAD * deviates).tolist(), strict=True)
        heart = heart.with_parameters({name: values[heart.path_of(name)] * ratio for name, ratio in ratios})
        return heart if world == "parameters" else _of_another_model(heart)

    def _measured(self, truth: Floats, true: Mapping[str, float], deviates: Floats) -> Twin:
        sd = np.array([self.noise[name] for name in true])
        seen = np.array(list(true.values())) * (1.0 + sd * deviates)
        return Twin(truth, dict(zip(true, seen.tolist(), strict=True)), np.diag(np.square(sd * seen)))


def _of_another_model(heart: Heart) -> Heart:
    valves = {name: getattr(VALVES, name) for name in BRANCHES}
    other = replace(heart, circulation=replace(heart.circulation, **valves))
    return other.with_parameters(OTHER_MODEL)
