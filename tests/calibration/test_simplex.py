"""The n+2 points have the exact mean and covariance, and a linear map keeps them when one is lost."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from heartfit.calibration.design import Simplex
from heartfit.calibration.unscented import CalibrationError, sigma_points, transform
from tests.calibration.maps import random_prior

simplices = some.builds(Simplex, centre=some.floats(0, 0.9), b=some.floats(0, 3))


@given(n=some.integers(1, 8), simplex=simplices)
def test_mean_covariance_and_distance_are_those_of_a_standard_gaussian(n: int, simplex: Simplex) -> None:
    points, weight = simplex.offsets(n), simplex.weights(n)[0]
    assert points.shape == (n + 2, n)
    assert weight.sum() == pytest.approx(1.0)
    assert weight @ points == pytest.approx(np.zeros(n), abs=1e-12)
    assert (weight[:, None] * points).T @ points == pytest.approx(np.eye(n), abs=1e-12)
    distance = np.sqrt(n / (1.0 - simplex.centre))
    assert np.linalg.norm(points[1:], axis=1) == pytest.approx(np.full(n + 1, distance))


@given(n=some.integers(1, 7), seed=some.integers(0, 1000), simplex=simplices, lost=some.integers(-1, 8))
def test_a_linear_map_is_exact_whichever_point_failed(n: int, seed: int, simplex: Simplex, lost: int) -> None:
    prior, a = random_prior(n, seed), np.random.default_rng(seed).standard_normal((3, n))
    points = sigma_points(prior, simplex)
    completed = np.arange(n + 2) != lost
    z = np.where(completed[:, None], np.array([point.z for point in points]) @ a.T + 5.0, np.nan)
    moments = transform(points, z, simplex, completed)
    assert moments.mean == pytest.approx(a @ prior.mean + 5.0, abs=1e-8)
    assert moments.cov_xz == pytest.approx(prior.covariance @ a.T, abs=1e-8)
    assert moments.cov_zz == pytest.approx(a @ prior.covariance @ a.T, abs=1e-8)
    assert moments.failed == tuple(np.array(simplex.labels(prior.names))[~completed])


def test_two_lost_points_are_refused_by_name() -> None:
    prior = random_prior(3, 0)
    points = sigma_points(prior, Simplex())
    with pytest.raises(CalibrationError, match="corner 0, corner 2"):
        transform(points, np.ones((5, 3)), Simplex(), np.array([True, False, True, False, True]))


def test_a_centre_point_with_all_weight_is_refused() -> None:
    with pytest.raises(ValueError, match=r"centre=1\.0"):
        Simplex(1.0)
