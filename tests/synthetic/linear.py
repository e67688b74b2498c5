"""A stand-in for the sphere whose observations are linear in the logarithms of its parameters."""

from collections.abc import Mapping, Sequence

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import Outcome
from heartfit.heart.heart import Heart
from heartfit.synthetic.known_hearts import KnownHeartSampler
from heartfit.synthetic.volunteer import OTHERS

ESTIMATED = ("sigma_0", "mu", "c_1", "R_p")
OBSERVED = ("V_min", "q_max", "q_min")
SLOPES = np.random.default_rng(8).standard_normal((len(ESTIMATED) + len(OTHERS), len(OBSERVED)))
PATHS = {name: Heart().parameter_path(name) for name in (*ESTIMATED, *OTHERS)}
STANDARD = {name: Heart().parameters()[path] for name, path in PATHS.items()}
LEVEL = 20.0
"""Size of the observations beside their changes: relative noise then is nearly the same for all hearts."""


class Linear:
    """Observations ln p times SLOPES; ``unseen`` scales the effect of the parameters that are not estimated."""

    def __init__(self, unseen: float = 1.0) -> None:
        self.heart = Heart()
        self._scale = np.array([1.0] * len(ESTIMATED) + [unseen] * len(OTHERS))

    def observe_all(self, parameters: Sequence[Mapping[str, float]]) -> list[Outcome]:
        return [self._observe(vector) for vector in parameters]

    def observe(self, heart: Heart) -> Outcome:
        values = heart.parameters()
        return self._observe({name: values[path] for name, path in PATHS.items()})

    def _observe(self, values: Mapping[str, float]) -> Outcome:
        point = np.array(
            [np.log(values.get(name, standard) / standard) for name, standard in STANDARD.items()]
        )
        return dict(zip(OBSERVED, (LEVEL + (point * self._scale) @ SLOPES).tolist(), strict=True))

    def slopes(self, names: Sequence[str], observations: Sequence[str], step: float) -> np.ndarray:
        return (self._scale[:, None] * SLOPES)[[[*STANDARD].index(name) for name in names]]


def linear_hearts(noise: float = 0.01, unseen: float = 1.0) -> KnownHeartSampler:
    means = {name: STANDARD[name] for name in ESTIMATED}
    prior = Gaussian.from_relative(means, dict.fromkeys(ESTIMATED, 0.2))
    return KnownHeartSampler(Linear(unseen), prior, dict.fromkeys(OBSERVED, noise), seed=3)  # type: ignore[arg-type]
