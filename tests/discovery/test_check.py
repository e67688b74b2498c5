"""Sampling agrees with Laplace where that is exact and corrects it where the model is curved."""

import numpy as np
import pytest
from scipy.stats import multivariate_normal, norm
from tests.discovery.linear import covariances, data, hypothesis, slopes

from heartfit.discovery.bench import Bench
from heartfit.discovery.check import sampled
from heartfit.discovery.explanation import Explanation
from heartfit.discovery.hypothesis import Coordinate, Hypothesis

ONE_SIDED = Coordinate("a", one_sided=True, amplitude=True)
GRID = np.linspace(-4.0, 4.0, 401)


def explained(given: Hypothesis, values: np.ndarray) -> Explanation:
    found = Bench(data(values)).explain(given, given.at(1.0))
    assert found is not None
    return found


@pytest.mark.parametrize("extra", [(), (ONE_SIDED,)])
def test_of_a_linear_model_it_is_the_exact_evidence(extra) -> None:
    y = slopes(3) @ np.array([0.5, -1.0, 0.4])
    found = explained(hypothesis(slopes(3), *extra), y)
    checked = sampled(found, data(y), 4000, seed=1)
    assert checked.effective > 1500
    assert checked.log_evidence == pytest.approx(found.log_evidence, abs=4.0 * checked.error)


def test_of_a_curved_model_it_is_the_integral_that_laplace_misses() -> None:
    J = slopes(2)
    bent = Hypothesis((), hypothesis(J).coordinates, lambda x: J[:, 0] * (x[0] + np.exp(x[1])))
    y = 3.0 * J[:, 0]
    a, b = (axis.ravel() for axis in np.meshgrid(GRID, GRID))
    residual = y[:, None] - np.outer(J[:, 0], a + np.exp(b))
    density = np.mean([multivariate_normal(cov=each).pdf(residual.T) for each in covariances()], axis=0)
    exact = np.log(np.sum(norm.pdf(a) * norm.pdf(b) * density) * (GRID[1] - GRID[0]) ** 2)
    found = explained(bent, y)
    checked = sampled(found, data(y), 4000)
    assert checked.log_evidence == pytest.approx(exact, abs=4.0 * checked.error)
    assert abs(found.log_evidence - exact) > abs(checked.log_evidence - exact)


def test_simulations_that_fail_count_as_impossible() -> None:
    """Half of the prior's mass is gone where the data say nothing of the coordinate that fails."""
    J = slopes(2) * [1.0, 0.0]
    whole = hypothesis(J)
    half = Hypothesis((), whole.coordinates, lambda x: J @ x if x[1] >= 0.0 else None)
    y = J[:, 0]
    lost = explained(half, y).log_evidence - sampled(explained(half, y), data(y), 4000).log_evidence
    assert lost == pytest.approx(np.log(2.0), abs=0.1)
