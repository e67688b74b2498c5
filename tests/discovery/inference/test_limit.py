"""The expected evidence of a linear model has a closed form; noisy data scatter about it."""

import numpy as np
import pytest

from heartfit.discovery.inference.data import Block
from heartfit.discovery.inference.hypothesis import Coordinate, Hypothesis
from heartfit.discovery.inference.plan import expected_log_bayes_factor, threshold_crossing
from tests.discovery.inference.linear import NOISE, TIMES, hypothesis, slopes

J = slopes(3)
NONE, SINGLE = hypothesis(J[:, :2]), hypothesis(J, Coordinate("a", amplitude=True))
BLOCKS = (Block("y", "m", TIMES, 1.0, NOISE),)
X = np.array([0.5, -1.0, 2.0])


def log_evidence(matrix: np.ndarray, values: np.ndarray) -> float:
    """ln N(y; 0, Sigma + J J') at the middle level."""
    covariance = NOISE.covariance(TIMES, 1.0, NOISE.middle) + matrix @ matrix.T
    return -0.5 * (np.linalg.slogdet(covariance)[1] + values @ np.linalg.solve(covariance, values))


def test_the_expected_evidence_of_a_linear_model_is_the_difference_of_two_gaussians() -> None:
    values = J @ X
    exact = log_evidence(J, values) - log_evidence(J[:, :2], values)
    assert expected_log_bayes_factor(NONE, SINGLE, BLOCKS, X) == pytest.approx(exact, abs=0.01)


def test_noise_adds_less_than_one_on_average() -> None:
    random, noise = np.random.default_rng(0), NOISE.covariance(TIMES, 1.0, NOISE.middle)
    values = J @ X + random.multivariate_normal(np.zeros(TIMES.size), noise, 2000)
    noisy = np.mean([log_evidence(J, vector) - log_evidence(J[:, :2], vector) for vector in values])
    assert 0.0 < noisy - expected_log_bayes_factor(NONE, SINGLE, BLOCKS, X) < 1.0


def test_failed_simulations_have_no_expected_evidence() -> None:
    dead = Hypothesis(("a",), SINGLE.coordinates, lambda x: None)
    assert expected_log_bayes_factor(NONE, dead, BLOCKS, X) is None


def test_the_limit_lies_where_the_line_crosses_the_threshold() -> None:
    assert threshold_crossing((1.0, 2.0), (2.0, 8.0), 5.0) == pytest.approx(1.5)
    assert threshold_crossing((1.0, 2.0), (10.0, 8.0), 5.0) == pytest.approx(0.5)
    assert threshold_crossing((1.0, 2.0), (2.0, 4.0), 5.0) is None
