"""Scatter of a sample: planted scatter is recovered, stays positive, and covers the next vector."""

import numpy as np
import pytest
from scipy.stats import t as student

from heartfit.observation.scatter import Scatter, shrinkage

SPREAD = np.array([[1.0, 0.6, 0.0], [0.6, 2.0, -0.5], [0.0, -0.5, 0.5]])


def draw(count: int, seed: int, mean: float = 0.3) -> np.ndarray:
    return np.random.default_rng(seed).multivariate_normal(np.full(3, mean), SPREAD, count)


def walks(count: int, steps: int = 25) -> np.ndarray:
    """Paths whose neighbours hardly differ, as errors of a curve are."""
    return np.random.default_rng(4).standard_normal((count, steps)).cumsum(axis=1)


def test_mean_and_covariance_are_recovered_within_their_sampling_error() -> None:
    scatter = Scatter.from_sample("abc", draw(4000, 0))
    assert np.abs(scatter.mean - 0.3).max() < 3.0 * np.sqrt(2.0 / 4000)
    variance = np.diag(SPREAD)
    error = np.sqrt((SPREAD**2 + np.outer(variance, variance)) / 4000)  # of a Wishart matrix
    assert (np.abs(scatter.covariance - SPREAD) < 3.0 * error).all()


def test_the_next_vector_lies_in_its_interval_at_the_nominal_rate() -> None:
    """2000 samples of 24, each with one new vector: within the binomial's 99 % of 95 %, and 68 %."""
    samples = draw(2000 * 25, 1).reshape(2000, 25, 3)
    for level in (0.95, 0.68):
        held = np.zeros(3)
        for sample in samples:
            scatter = Scatter.from_sample("abc", sample[:-1])
            held += np.abs(sample[-1] - scatter.mean) <= scatter.half_width(level)
        assert np.abs(held / 2000 - level).max() < 2.58 * np.sqrt(level * (1.0 - level) / 2000)


def test_the_reach_is_the_quantile_of_student() -> None:
    scatter = Scatter(("a",), 24, np.zeros(1), np.array([[4.0]]))
    assert scatter.half_width(0.9) == pytest.approx([2.0 * student.ppf(0.95, 23) * np.sqrt(25.0 / 24.0)])
    assert scatter.predictive == pytest.approx(np.array([[4.0 * 25.0 / 24.0]]))


def test_a_shrunken_covariance_is_positive_and_keeps_its_variances() -> None:
    sample = walks(24, 40)
    plain, shrunken = (
        Scatter.from_sample(range(40), sample),
        Scatter.from_sample(range(40), sample, shrunk=True),
    )
    assert np.linalg.matrix_rank(plain.covariance) == 23
    assert np.linalg.eigvalsh(shrunken.covariance).min() > 1e-3 * plain.sd.min() ** 2
    assert np.diag(shrunken.covariance) == pytest.approx(np.diag(plain.covariance))
    assert shrunken.half_width() == pytest.approx(plain.half_width())


def test_shrinkage_is_small_for_a_known_correlation_and_large_for_none() -> None:
    assert shrinkage(walks(2000)) < 0.01
    assert shrinkage(np.random.default_rng(2).standard_normal((24, 25))) > 0.7


def test_shrinkage_is_the_published_sum() -> None:
    """Schafer and Strimmer 2005, term by term."""
    sample = draw(12, 3)
    normal = (sample - sample.mean(axis=0)) / sample.std(axis=0, ddof=1)
    variance = size = 0.0
    for i, j in ((0, 1), (0, 2), (1, 2)):
        w = normal[:, i] * normal[:, j]
        variance += 12 / 11**3 * ((w - w.mean()) ** 2).sum()
        size += (12 / 11 * w.mean()) ** 2
    assert shrinkage(sample) == pytest.approx(variance / size)


def test_a_component_that_never_varies_has_no_scatter() -> None:
    sample = walks(24)
    sample[:, 0] = 0.5
    scatter = Scatter.from_sample(range(25), sample, shrunk=True)
    assert not scatter.covariance[0].any()
    assert scatter.mean[0] == 0.5
    assert np.linalg.eigvalsh(scatter.covariance[1:, 1:]).min() > 0.0
