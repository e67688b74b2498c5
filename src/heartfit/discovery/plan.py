r"""Which further measurement would tell explanations apart.

Under the explanation A of the data so far, linear about its fit, a further measurement is Gaussian with

.. math:: \mu_A = f_A(x_A), \qquad S_A = \Sigma + J_A C_A J_A^T,

C_A the posterior covariance of its coordinates, so that what A leaves open is allowed to answer. If A is true, the ln
Bayes factor over B that the measurement adds is on average the divergence of the two,

.. math:: \tfrac12 \Bigl(\mathrm{tr}\, S_B^{-1} S_A - n + (\mu_B - \mu_A)^T S_B^{-1} (\mu_B - \mu_A)
          + \ln \frac{|S_B|}{|S_A|}\Bigr) .

A measurement is worth what it adds for the worst pair. This is T-optimality with Gaussian priors.

References: Atkinson and Fedorov 1975, doi:10.1093/biomet/62.1.57; Box and Hill 1967,
doi:10.1080/00401706.1967.10490441.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import permutations

import numpy as np
from scipy.linalg import block_diag, cho_factor, cho_solve

from heartfit.discovery.data import Block
from heartfit.discovery.decide import Effects
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.forward import Counted
from heartfit.discovery.hypothesis import Coordinate, Hypothesis
from heartfit.geometry.arrays import Floats

ENOUGH = 3.0
"""ln Bayes factor that tells two explanations apart (Kass and Raftery's "positive")."""


@dataclass(frozen=True, eq=False)
class Measurement:
    """What could be measured: its name, cost in any unit, curves, and the model of it under some effects.

    own: unknowns of the measurement itself, N(0, 1), such as the load under which it is taken; they follow the
    coordinates of the hypothesis in what ``forward`` gives. times in the blocks count, values do not exist yet.
    """

    name: str
    cost: float
    blocks: tuple[Block, ...]
    forward: Callable[[Effects], Callable[[Floats], Floats | None]]
    own: int = 0


@dataclass(frozen=True)
class Prospect:
    """What a measurement is expected to add to the ln Bayes factor of any two explanations, and its simulations."""

    name: str
    cost: float
    gain: float
    simulations: int


def plan(explanations: Sequence[Explanation], measurements: Sequence[Measurement]) -> tuple[Prospect, ...]:
    """The prospects of all measurements: first those that tell the explanations apart, the cheapest leading.

    A measurement that some explanation cannot simulate is left out.
    """
    prospects = [prospect(explanations, each) for each in measurements]
    return tuple(sorted((each for each in prospects if each is not None), key=_order))


def _order(each: Prospect) -> tuple[bool, float]:
    enough = each.gain >= ENOUGH
    return not enough, each.cost if enough else -each.gain


def prospect(explanations: Sequence[Explanation], measurement: Measurement) -> Prospect | None:
    """What one measurement adds for the worst pair, or None where it cannot be simulated."""
    models = [Counted(_hypothesis(each, measurement)) for each in explanations]
    seen = [_prediction(each, measurement, model) for each, model in zip(explanations, models, strict=True)]
    predictions = [each for each in seen if each is not None]
    if len(predictions) < len(seen):
        return None
    gain = min(divergence(*one, *other) for one, other in permutations(predictions, 2))
    return Prospect(measurement.name, measurement.cost, gain, sum(model.runs for model in models))


def divergence(mean: Floats, covariance: Floats, other_mean: Floats, other_covariance: Floats) -> float:
    """E[ln p / q] under p of two Gaussians, p first."""
    factor = cho_factor(other_covariance)
    apart = other_mean - mean
    spread = np.trace(cho_solve(factor, covariance)) - mean.size
    volumes = np.linalg.slogdet(other_covariance)[1] - np.linalg.slogdet(covariance)[1]
    return 0.5 * float(spread + apart @ cho_solve(factor, apart) + volumes)


def _hypothesis(explanation: Explanation, measurement: Measurement) -> Hypothesis:
    """The explanation's hypothesis as the further measurement sees it."""
    own = tuple(Coordinate(f"{measurement.name} {index}") for index in range(measurement.own))
    known = explanation.fit.hypothesis
    return Hypothesis(known.effects, (*known.coordinates, *own), measurement.forward(known.effects))


def _prediction(
    explanation: Explanation, measurement: Measurement, model: Counted
) -> tuple[Floats, Floats] | None:
    """Mean (m,) and covariance (m, m) of the measurement."""
    x = np.concatenate([explanation.fit.x, np.zeros(measurement.own)])
    mean = model(x)
    if mean is None:
        return None
    jacobian = model.jacobian(x, mean)
    free = block_diag(explanation.posterior.covariance, np.eye(measurement.own))
    noise = [each.noise.covariance(each.times, each.period, each.noise.middle) for each in measurement.blocks]
    return mean, block_diag(*noise) + jacobian @ free @ jacobian.T
