"""The update equals the Kalman filter's closed forms on linear maps."""

import re
from collections.abc import Iterator
from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import CalibrationError, Scaling, sigma_points, transform
from heartfit.calibration.update import calibrate, long_steps, update

NAMES = ("V_min", "q_max", "q_min")
NOISE = np.diag([0.01, 0.02, 0.005])


def linear(n: int, m: int, seed: int) -> tuple[Gaussian, np.ndarray, np.ndarray, np.ndarray]:
    """A prior, a map z = A x + c, its values at the sigma points and an observed vector."""
    random = np.random.default_rng(seed)
    prior = Gaussian(
        tuple(f"p{i}" for i in range(n)), random.standard_normal(n), np.diag(random.uniform(0.1, 0.4, n) ** 2)
    )
    a = random.standard_normal((m, n))
    z = np.array([point.z for point in sigma_points(prior)]) @ a.T + 1.0
    return prior, a, z, a @ prior.mean + 1.0 + 0.1 * random.standard_normal(m)


def kalman(prior: Gaussian, a: np.ndarray, observed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Mean and covariance after observing z = A x + 1 with NOISE."""
    covariance = np.linalg.inv(np.linalg.inv(prior.covariance) + a.T @ np.linalg.inv(NOISE) @ a)
    return prior.mean + covariance @ a.T @ np.linalg.inv(NOISE) @ (
        observed - 1.0 - a @ prior.mean
    ), covariance


def losses(n: int) -> Iterator[tuple[int, ...]]:
    """Every one and every two of the sigma points of n parameters."""
    for count in (1, 2):
        yield from combinations(range(2 * n + 1), count)


def named(z: np.ndarray) -> dict[str, float]:
    return dict(zip(NAMES, z, strict=False))


@given(n=some.integers(3, 7), seed=some.integers(0, 500))
def test_without_noise_the_observations_are_met_by_the_smallest_step(n: int, seed: int) -> None:
    prior, a, z, observed = linear(n, 3, seed)
    posterior = update(prior, transform(sigma_points(prior), z), named(observed))
    assert a @ posterior.estimate.mean + 1.0 == pytest.approx(observed, abs=1e-6)
    root = np.diag(prior.sd)
    least = root @ np.linalg.lstsq(a @ root, observed - 1.0 - a @ prior.mean, rcond=None)[0]
    assert posterior.estimate.mean - prior.mean == pytest.approx(least, abs=1e-6)
    assert posterior.step == pytest.approx(least / prior.sd, abs=1e-5)


@given(n=some.integers(1, 7), seed=some.integers(0, 500))
def test_with_noise_mean_and_covariance_are_the_kalman_ones(n: int, seed: int) -> None:
    prior, a, z, observed = linear(n, 3, seed)
    posterior = update(prior, transform(sigma_points(prior), z), named(observed), NOISE)
    mean, covariance = kalman(prior, a, observed)
    assert posterior.estimate.mean == pytest.approx(mean, abs=1e-8)
    assert posterior.estimate.covariance == pytest.approx(covariance, abs=1e-8)


def test_an_uninformed_direction_keeps_its_prior() -> None:
    prior, a, z, observed = linear(4, 3, 11)
    posterior = update(prior, transform(sigma_points(prior), z), named(observed))
    null = np.linalg.svd(a @ np.diag(prior.sd))[2][-1] / prior.sd
    kept = null @ posterior.estimate.covariance @ null
    assert kept == pytest.approx(null @ prior.covariance @ null, rel=1e-6)
    assert null @ (posterior.estimate.mean - prior.mean) == pytest.approx(0, abs=1e-8)


@given(seed=some.integers(0, 200), exponents=some.lists(some.integers(-9, 6), min_size=3, max_size=3))
def test_the_units_of_the_observations_do_not_matter(seed: int, exponents: list[int]) -> None:
    prior, _, z, observed = linear(4, 3, seed)
    unit = 10.0 ** np.array(exponents)
    first = update(prior, transform(sigma_points(prior), z), named(observed))
    other = update(prior, transform(sigma_points(prior), z * unit), named(observed * unit))
    assert other.estimate.mean == pytest.approx(first.estimate.mean, rel=1e-6, abs=1e-6)
    assert other.singular_values == pytest.approx(first.singular_values, rel=1e-6)
    assert other.sensitivity == pytest.approx(first.sensitivity, rel=1e-6, abs=1e-9)


def test_sensitivities_are_correlations_on_a_linear_map() -> None:
    prior, a, z, observed = linear(4, 3, 5)
    posterior = update(prior, transform(sigma_points(prior), z), named(observed))
    influence = (a * prior.sd).T
    assert posterior.sensitivity == pytest.approx(influence / np.linalg.norm(influence, axis=0))


def test_collinear_observations_are_refused_unless_they_carry_noise() -> None:
    prior, _, z, observed = linear(4, 3, 2)
    z[:, 2], observed[2] = 2 * z[:, 0], 2 * observed[0]
    moments = transform(sigma_points(prior), z)
    with pytest.raises(CalibrationError, match="collinear"):
        update(prior, moments, named(observed))
    update(prior, moments, named(observed), np.diag(np.square(0.1 * observed)))


def test_an_observation_without_sensitivity_is_refused() -> None:
    prior, _, z, observed = linear(4, 3, 2)
    z[:, 1] = 7.0
    with pytest.raises(CalibrationError, match=r"parameter.*\bq_max\b"):
        update(prior, transform(sigma_points(prior), z), named(observed))


def test_more_observations_than_parameters_without_noise_are_reported() -> None:
    prior = Gaussian.from_relative({"mu": 7e3, "R_p": 1e8}, {"mu": 0.2, "R_p": 0.2})
    z = np.exp([point.z - prior.mean for point in sigma_points(prior)])
    moments = transform(sigma_points(prior), np.column_stack([z, z[:, 0] ** 3 + z[:, 1]]))
    posterior = update(prior, moments, named(moments.mean))
    assert re.search(r"\b3 observations.*\b2 parameters", posterior.notes[0])
    assert not update(prior, moments, named(moments.mean), 0.01 * np.eye(3)).notes


@pytest.mark.parametrize("size", [4.0, -4.0])
def test_a_long_step_in_either_direction_is_reported(size: float) -> None:
    prior, a, z, _ = linear(3, 3, 4)
    far = a @ (prior.mean + np.array([size, 0, 0]) * prior.sd) + 1.0
    posterior = update(prior, transform(sigma_points(prior), z), named(far))
    assert len(posterior.notes) == 1
    assert re.search(rf"\bp0\b.*{re.escape(f'{size:+.1f}')}\b", posterior.notes[0])


def test_a_step_is_long_beyond_two_and_a_half_prior_deviations_in_either_direction() -> None:
    assert long_steps(("K", "mu", "R_p"), [-2.6, 2.4, 2.51]) == {"K": -2.6, "R_p": 2.51}


@pytest.mark.parametrize("n", [4, 7])
def test_with_any_failed_beats_the_closed_form_holds_or_the_update_refuses(n: int) -> None:
    """Both sigma points of a parameter are refused; a loss of any others leaves the linear map exact."""
    for failed in losses(n):
        prior, a, z, observed = linear(n, 3, n + sum(failed))
        outcomes = ["inverted" if i in failed else named(row) for i, row in enumerate(z)]
        if len(failed) == 2 and failed[0] > 0 and failed[1] == failed[0] + n:
            name = f"p{failed[0] - 1}"
            with pytest.raises(CalibrationError, match=rf"{name}\+ \(inverted\).*{name}-"):
                calibrate(prior, outcomes, named(observed), NOISE)
            continue
        posterior = calibrate(prior, outcomes, named(observed), NOISE)
        mean, covariance = kalman(prior, a, observed)
        assert posterior.estimate.mean == pytest.approx(mean, abs=1e-8), failed
        assert posterior.estimate.covariance == pytest.approx(covariance, abs=1e-8), failed
        labels = [point.label for point in sigma_points(prior)]
        assert posterior.failed == tuple(f"{labels[i]} (inverted)" for i in failed)


def test_failed_beats_are_excluded_and_reported() -> None:
    prior, a, z, observed = linear(4, 3, 9)
    outcomes = [named(row) for row in z]
    outcomes[2] = "beat 1: at 0.3 s: an element collapsed"
    posterior = calibrate(prior, outcomes, named(observed))
    assert a @ posterior.estimate.mean + 1.0 == pytest.approx(observed, abs=1e-6)
    assert posterior.notes == (
        "failed sigma points: p1+ (beat 1: at 0.3 s: an element collapsed); weights rescaled over the rest, "
        "exact for a linear model",
    )


def test_missing_beats_and_missing_observations_are_refused() -> None:
    prior, _, z, observed = linear(4, 3, 9)
    outcomes = [named(row) for row in z]
    with pytest.raises(ValueError, match=r"\b8 outcomes.*\b9 points"):
        calibrate(prior, outcomes[:-1], named(observed))
    with pytest.raises(KeyError, match="V_min"):
        calibrate(prior, [*outcomes[:-1], {}], named(observed))


def test_an_observation_that_moves_by_rounding_only_is_refused() -> None:
    prior, _, z, observed = linear(4, 3, 2)
    z[:, 1] = 7e-5 * (1.0 + 1e-15 * np.arange(9))
    with pytest.raises(CalibrationError, match=r"parameter.*\bq_max\b"):
        update(prior, transform(sigma_points(prior), z), named(observed))


@given(seed=some.integers(0, 200))
def test_a_negative_covariance_is_refused_never_clipped(seed: int) -> None:
    """kappa = 3 - n weighs the centre negatively for n > 3: on a curved map it claims less than no variance."""
    prior, a, _, observed = linear(5, 2, seed)
    julier = Scaling(b=0.0, kappa=-2.0)
    points = sigma_points(prior, julier)
    deviation = np.array([point.z for point in points]) - prior.mean
    z = deviation @ a.T + 40.0 * np.square(deviation / prior.sd).sum(axis=1, keepdims=True)
    with pytest.raises(CalibrationError, match=r"negative.*centre"):
        update(prior, transform(points, z, julier), named(observed))


@pytest.mark.parametrize("noise", [np.array([0.01, 0.02, 0.005]), [0.1, 0.1, 0.1], np.eye(2), 0.01])
def test_noise_that_is_no_covariance_of_the_observations_is_refused(noise: object) -> None:
    prior, _, z, observed = linear(4, 3, 0)
    outcomes = [dict(zip(NAMES, row, strict=True)) for row in z.tolist()]
    with pytest.raises(
        CalibrationError, match=r"expected \(3, 3\), the covariance of V_min, q_max, q_min.*diag"
    ):
        calibrate(prior, outcomes, dict(zip(NAMES, observed.tolist(), strict=True)), noise)  # type: ignore[arg-type]


def test_noise_and_prior_may_be_lists() -> None:
    prior, _, z, observed = linear(4, 3, 0)
    outcomes = [dict(zip(NAMES, row, strict=True)) for row in z.tolist()]
    data = dict(zip(NAMES, observed.tolist(), strict=True))
    listed = Gaussian(list(prior.names), prior.mean.tolist(), prior.covariance.tolist())  # type: ignore[arg-type]
    first, second = (calibrate(p, outcomes, data, r) for p, r in ((prior, NOISE), (listed, NOISE.tolist())))  # type: ignore[arg-type]
    assert np.array_equal(first.estimate.mean, second.estimate.mean)


def test_an_outcome_without_an_observation_is_named() -> None:
    prior, _, z, observed = linear(4, 3, 0)
    outcomes = [dict(zip(NAMES[:2], row, strict=False)) for row in z.tolist()]
    with pytest.raises(KeyError, match="an outcome has no q_min, which is observed"):
        calibrate(prior, outcomes, dict(zip(NAMES, observed.tolist(), strict=True)), NOISE)
