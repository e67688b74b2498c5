"""Share of a bivariate normal in the first quadrant: closed forms, and bounds far in the tails."""

import numpy as np
import pytest
from scipy.special import log_ndtr
from scipy.stats import multivariate_normal

from heartfit.discovery.inference.orthant import log_share


def covariance(correlation: float, first: float = 1.0, second: float = 1.0) -> np.ndarray:
    product = correlation * first * second
    return np.array([[first**2, product], [product, second**2]])


@pytest.mark.parametrize("correlation", [-0.999, -0.6, 0.0, 0.8, 0.999])
def test_at_the_origin_the_share_is_sheppard_s(correlation: float) -> None:
    """1/4 + arcsin(r) / 2 pi (Sheppard 1899)."""
    share = log_share(np.zeros(2), covariance(correlation, 0.3, 2.0))
    assert np.exp(share) == pytest.approx(0.25 + np.arcsin(correlation) / (2.0 * np.pi), rel=1e-4)


def test_many_shares_are_those_of_the_cumulative_distribution() -> None:
    rng = np.random.default_rng(0)
    mean, correlation = rng.normal(0.0, 1.5, (40, 2)), rng.uniform(-0.9, 0.9, 40)
    matrices = np.array([covariance(r) for r in correlation])
    exact = [multivariate_normal(-m, C).cdf(np.zeros(2)) for m, C in zip(mean, matrices, strict=True)]
    assert np.exp(log_share(mean, matrices)) == pytest.approx(exact, abs=1e-7)


def test_in_the_tails_independent_shares_multiply_and_equal_ones_are_one() -> None:
    far = np.array([-25.0, -12.0])
    assert log_share(far, np.eye(2)) == pytest.approx(log_ndtr(far).sum(), abs=1e-6)
    assert log_share(far, covariance(1.0)) == pytest.approx(log_ndtr(-25.0), abs=1e-3)
    assert log_share(far[:1], np.eye(1)) == pytest.approx(log_ndtr(-25.0))


def test_opposite_amplitudes_below_their_bounds_share_next_to_nothing() -> None:
    """Leading order exp(-h R^-1 h / 2) for h = (2, 2.5) and r = -0.95; independent ones would keep 1e-4."""
    bound = np.array([2.0, 2.5])
    matrix = covariance(-0.95)
    expected = multivariate_normal(np.zeros(2), matrix).logpdf(bound) - np.log(
        np.linalg.solve(matrix, bound).prod()
    )
    assert log_share(-bound, matrix) == pytest.approx(expected, abs=0.05)
