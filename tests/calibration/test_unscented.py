"""The transform is exact on linear maps, whole or with failed points, and sees curvature."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import CalibrationError, Scaling, sigma_points, transform

scalings = some.builds(Scaling, a=some.floats(0.3, 1.5), b=some.floats(0, 3), kappa=some.floats(0, 3))


def random_prior(n: int, seed: int) -> Gaussian:
    random = np.random.default_rng(seed)
    root = random.standard_normal((n, n)) + 2 * np.eye(n)
    return Gaussian(tuple(f"p{i}" for i in range(n)), random.standard_normal(n), 0.04 * root @ root.T)


def points_of(prior: Gaussian, scaling: Scaling) -> np.ndarray:
    return np.array([point.z for point in sigma_points(prior, scaling)])


@given(n=some.integers(1, 8), seed=some.integers(0, 1000), scaling=scalings)
def test_covariance_of_the_parameters_is_reproduced(n: int, seed: int, scaling: Scaling) -> None:
    prior = random_prior(n, seed)
    x = points_of(prior, scaling)
    moments = transform(sigma_points(prior, scaling), x, scaling)
    assert moments.mean == pytest.approx(prior.mean, abs=1e-9)
    assert moments.cov_xz == pytest.approx(prior.covariance, rel=1e-7, abs=1e-9)
    assert moments.cov_zz == pytest.approx(prior.covariance, rel=1e-7, abs=1e-9)


@given(seed=some.integers(0, 1000), scaling=scalings)
def test_weights_sum_to_one_and_points_are_labelled(seed: int, scaling: Scaling) -> None:
    prior = random_prior(4, seed)
    mean, covariance = scaling.weights(4)
    assert mean.sum() == pytest.approx(1)
    assert covariance.sum() == pytest.approx(2 - scaling.a**2 + scaling.b)
    assert [p.label for p in sigma_points(prior)][::4] == ["centre", "p3+", "p3-"]


def test_default_points_lie_at_root_n_and_differ_in_one_parameter() -> None:
    prior = Gaussian.from_relative({"sigma_0": 240e3, "mu": 7e3}, {"sigma_0": 0.2, "mu": 0.3})
    plus = sigma_points(prior)[1]
    assert plus.label == "sigma_0+"
    assert plus.parameters["sigma_0"] == pytest.approx(240e3 * np.exp(0.2 * np.sqrt(2)))
    assert plus.parameters["mu"] == pytest.approx(7e3)


@given(seed=some.integers(0, 1000))
def test_a_square_has_the_gaussian_mean_and_variance(seed: int) -> None:
    """z = x^2 with x ~ N(0, s^2): mean s^2, variance 2 s^4, covariance with x zero."""
    s = np.random.default_rng(seed).uniform(0.1, 3)
    prior = Gaussian(("x",), np.zeros(1), np.array([[s**2]]))
    moments = transform(sigma_points(prior), points_of(prior, Scaling()) ** 2)
    assert moments.mean == pytest.approx([s**2])
    assert moments.cov_xz == pytest.approx(np.zeros((1, 1)), abs=1e-12)
    assert moments.cov_zz == pytest.approx(np.array([[2 * s**4]]))


@given(n=some.integers(1, 7), seed=some.integers(0, 1000), scaling=scalings, data=some.data())
def test_a_linear_map_is_exact_despite_failed_points_or_the_points_are_refused(
    n: int, seed: int, scaling: Scaling, data: some.DataObject
) -> None:
    prior = random_prior(n, seed)
    a = np.random.default_rng(seed).standard_normal((3, n))
    completed = np.array(data.draw(some.lists(some.booleans(), min_size=2 * n + 1, max_size=2 * n + 1)))
    z = np.where(completed[:, None], points_of(prior, scaling) @ a.T + 5.0, np.nan)
    up, down = completed[1 : n + 1], completed[n + 1 :]
    if not (up | down).all() or not (completed[0] or (up & down).any()):
        with pytest.raises(CalibrationError, match="failed"):
            transform(sigma_points(prior, scaling), z, scaling, completed)
        return
    moments = transform(sigma_points(prior, scaling), z, scaling, completed)
    assert moments.mean == pytest.approx(a @ prior.mean + 5.0, abs=1e-7)
    assert moments.cov_xz == pytest.approx(prior.covariance @ a.T, abs=1e-7)
    assert moments.cov_zz == pytest.approx(a @ prior.covariance @ a.T, abs=1e-7)
    assert len(moments.failed) == (~completed).sum()


@given(seed=some.integers(0, 1000), lost=some.integers(1, 8))
def test_a_failed_point_keeps_the_covariances_of_other_parameters(seed: int, lost: int) -> None:
    """A square of one parameter bends no covariance with another, though the mean moves off the centre."""
    prior = random_prior(4, seed)
    points = sigma_points(prior)
    deviation = points_of(prior, Scaling()) - prior.mean
    bent = np.abs(deviation @ np.linalg.inv(np.linalg.cholesky(prior.covariance)).T)
    i = (lost - 1) % 4
    z = np.delete(bent, i, axis=1) ** 2
    moments = transform(points, z, completed=np.arange(9) != lost)
    assert moments.cov_xz == pytest.approx(transform(points, z).cov_xz, abs=1e-9)


@pytest.mark.parametrize(
    ("lost", "message"),
    [([1, 5], r"p0\+.*p0-"), ([0, 1, 6, 3, 8], r"centre.*pair")],
)
def test_points_that_do_not_suffice_are_refused(lost: list[int], message: str) -> None:
    prior = random_prior(4, 0)
    completed = ~np.isin(np.arange(9), lost)
    with pytest.raises(CalibrationError, match=message):
        transform(sigma_points(prior), points_of(prior, Scaling()), completed=completed)


def test_an_unmasked_nan_is_refused() -> None:
    prior = random_prior(2, 0)
    z = np.ones((5, 1))
    z[3] = np.nan
    with pytest.raises(ValueError, match="p0-"):
        transform(sigma_points(prior), z)
