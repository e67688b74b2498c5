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
    prior = Gaussian.of_relative({"sigma_0": 240e3, "mu": 7e3}, {"sigma_0": 0.2, "mu": 0.3})
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


@given(n=some.integers(1, 6), seed=some.integers(0, 1000), scaling=scalings, data=some.data())
def test_one_failed_point_in_each_pair_leaves_a_linear_map_exact(
    n: int, seed: int, scaling: Scaling, data: some.DataObject
) -> None:
    prior = random_prior(n, seed)
    a = np.random.default_rng(seed).standard_normal((3, n))
    completed = np.ones(2 * n + 1, dtype=bool)
    for i in range(n):
        completed[data.draw(some.sampled_from([0, 1 + i, 1 + i + n]))] = False
    completed[0] = True
    z = np.where(completed[:, None], points_of(prior, scaling) @ a.T + 5.0, np.nan)
    moments = transform(sigma_points(prior, scaling), z, scaling, completed)
    assert moments.mean == pytest.approx(a @ prior.mean + 5.0, abs=1e-8)
    assert moments.cov_xz == pytest.approx(prior.covariance @ a.T, abs=1e-8)
    assert moments.cov_zz == pytest.approx(a @ prior.covariance @ a.T, abs=1e-8)
    assert len(moments.failed) == (~completed).sum()


def test_a_failed_centre_leaves_a_linear_map_exact() -> None:
    prior, scaling = random_prior(4, 7), Scaling(kappa=1.0)
    completed = np.arange(9) > 0
    moments = transform(sigma_points(prior, scaling), points_of(prior, scaling), scaling, completed)
    assert moments.mean == pytest.approx(prior.mean)
    assert moments.cov_zz == pytest.approx(prior.covariance)
    assert moments.failed == ("centre",)


@pytest.mark.parametrize(
    ("lost", "message"), [([1, 5], r"p0\+ and p0- both"), ([0, 6], "the centre and one of p1")]
)
def test_points_that_do_not_suffice_are_refused(lost: list[int], message: str) -> None:
    prior = random_prior(4, 0)
    completed = ~np.isin(np.arange(9), lost)
    with pytest.raises(CalibrationError, match=message):
        transform(sigma_points(prior), points_of(prior, Scaling()), completed=completed)


def test_a_nan_that_no_mask_explains_is_refused() -> None:
    prior = random_prior(2, 0)
    z = np.ones((5, 1))
    z[3] = np.nan
    with pytest.raises(ValueError, match="p0- observed as not finite"):
        transform(sigma_points(prior), z)
