"""The first step is the paper's, a linear map is done after it, and a curved one converges to the exact answer."""

from itertools import islice

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some
from scipy.optimize import minimize

from heartfit.calibration.alternatives import iterate
from heartfit.calibration.design import Simplex
from heartfit.calibration.unscented import (
    STANDARD_DESIGN,
    CalibrationError,
    CountedForward,
    Scaling,
    sigma_points,
)
from heartfit.calibration.update import calibrate
from tests.calibration.maps import NOISE, failing, forward_of, kalman, named, random_prior, slopes


@pytest.mark.parametrize("noise", [None, NOISE])
@pytest.mark.parametrize("design", [STANDARD_DESIGN, Simplex(), Scaling(0.5)])
def test_the_first_step_is_the_unscented_one(noise, design) -> None:
    prior, a = random_prior(4, 3), slopes(4, 3)
    forward = forward_of(prior, lambda x: a @ x + 0.1 * (a @ x) ** 2)
    observed = named(np.array([0.3, -0.2, 0.4]))
    outcomes = forward([point.parameters for point in sigma_points(prior, design)])
    expected = calibrate(prior, outcomes, observed, noise, design).estimate
    first = next(iterate(prior, forward, observed, noise, design)).estimate
    assert first.mean == pytest.approx(expected.mean, rel=1e-9)
    assert first.covariance == pytest.approx(expected.covariance, rel=1e-9, abs=1e-12)


@given(n=some.integers(2, 7), seed=some.integers(0, 300), simplex=some.booleans())
def test_on_a_linear_map_every_step_is_the_posterior(n: int, seed: int, simplex: bool) -> None:
    """Estimate and covariance stay the same: the data are used once."""
    prior, a = random_prior(n, seed), slopes(n, seed)
    observed = a @ prior.mean + 0.1
    mean, covariance = kalman(prior, a, observed)
    design = Simplex() if simplex else STANDARD_DESIGN
    steps = iterate(prior, forward_of(prior, lambda x: a @ x), named(observed), NOISE, design)
    for posterior in islice(steps, 3):
        assert posterior.estimate.mean == pytest.approx(mean, abs=1e-6)
        assert posterior.estimate.covariance == pytest.approx(covariance, abs=1e-6)


def bent(a: np.ndarray, x: np.ndarray) -> np.ndarray:
    return np.exp(0.5 * a @ x)


def test_with_noise_the_iteration_converges_to_the_maximum_a_posteriori() -> None:
    prior, a = random_prior(4, 7), slopes(4, 7)
    observed = bent(a, prior.mean) * np.array([1.5, 0.8, 1.2])
    inverse, weight = np.linalg.inv(prior.covariance), np.linalg.inv(NOISE)

    def cost(x: np.ndarray) -> float:
        off, residual = x - prior.mean, bent(a, x) - observed
        return float(off @ inverse @ off + residual @ weight @ residual)

    best = minimize(cost, prior.mean, method="BFGS", options={"gtol": 1e-9}).x
    iterations = islice(iterate(prior, forward_of(prior, lambda x: bent(a, x)), named(observed), NOISE), 12)
    away = [np.linalg.norm(posterior.estimate.mean - best) for posterior in iterations]
    assert away[-1] < 1e-4 < away[0]


def test_without_noise_the_iteration_meets_observations_that_one_step_misses() -> None:
    prior, a = random_prior(4, 7), slopes(4, 7)
    observed = bent(a, prior.mean) * np.array([1.5, 0.8, 1.2])
    iterations = islice(iterate(prior, forward_of(prior, lambda x: bent(a, x)), named(observed)), 10)
    missed = [np.abs(bent(a, iteration.estimate.mean) / observed - 1.0).max() for iteration in iterations]
    assert missed[-1] < 1e-6 < 1e-2 < missed[0]


def test_each_step_costs_the_points_of_its_design_and_survives_a_failure() -> None:
    prior, a = random_prior(4, 1), slopes(4, 1)
    forward = CountedForward(failing(forward_of(prior, lambda x: a @ x), [2, 11]))
    observed = named(a @ prior.mean + 0.1)
    iterations = list(islice(iterate(prior, forward, observed, NOISE), 2))
    assert forward.simulations == 18
    assert [posterior.failed for posterior in iterations] == [("p1+ (no beat)",)] * 2
    assert iterations[1].estimate.mean == pytest.approx(kalman(prior, a, np.array([*observed.values()]))[0])


def test_failure_of_all_points_is_reported() -> None:
    prior = random_prior(2, 0)
    forward = failing(forward_of(prior, lambda x: np.ones(3)), range(5))
    with pytest.raises(CalibrationError, match="both failed"):
        next(iterate(prior, forward, named(np.ones(3)), NOISE))
