"""Optimisation of a refit: exact on a linear model, correct with inexact slopes, within bounds, after a failed beat."""

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.descent import EXPENSIVE, LONGEST_STEP, Descent, InverseProblem
from heartfit.discovery.refit.target import Target
from heartfit.discovery.sphere_model.recording import Samples

RNG = np.random.default_rng(5)
SLOPES = RNG.standard_normal((12, 3))
TRUTH = np.array([0.6, -0.4, 1.0])
NOISE = 0.05**2 * np.eye(12)
TARGET = Target({"lv_volume": Samples(np.arange(12.0), SLOPES @ TRUTH)}, NOISE)
FREE = np.full(3, -np.inf)


def linear(x: Floats) -> Floats:
    return SLOPES @ x


def bent(x: Floats) -> Floats:
    return SLOPES @ (x + 0.15 * x**2)


def walked(walk: Descent, most: int = 30) -> Descent:
    for _ in range(most):
        if walk.ended:
            break
        walk.advance()
    return walk


def started(
    forward,
    slopes: Floats = SLOPES,
    lower: Floats = FREE,
    target: Target = TARGET,
    x: Floats | None = None,
) -> Descent:
    start = np.zeros(3) if x is None else x
    problem = InverseProblem(forward, target.values(), target, lower)
    return Descent(problem, EXPENSIVE, start, forward(start), slopes)


def test_a_linear_model_ends_at_its_posterior() -> None:
    precision = np.eye(3) + SLOPES.T @ np.linalg.solve(NOISE, SLOPES)
    mean = np.linalg.solve(precision, SLOPES.T @ np.linalg.solve(NOISE, TARGET.values()))
    walk = walked(started(linear))
    assert walk.converged
    assert walk.x == pytest.approx(mean, abs=5e-3)
    assert walk.covariance() == pytest.approx(np.linalg.inv(precision))


def test_inexact_slopes_are_corrected_by_updates() -> None:
    off = 1.5 * np.random.default_rng(3).standard_normal(SLOPES.shape)
    walk = walked(started(bent, SLOPES + off), 12)
    assert walk.converged
    assert bent(walk.x) == pytest.approx(TARGET.values(), abs=0.05)


def test_an_amplitude_that_the_data_push_below_its_bound_stays_there() -> None:
    start = np.array([0.0, 0.3, 0.0])
    walk = walked(started(linear, lower=np.array([-np.inf, 0.0, -np.inf]), x=start))
    assert walk.converged
    assert walk.x[1] == 0.0


def test_other_parameters_are_refitted_where_an_amplitude_meets_its_bound() -> None:
    """A step that is only cut off at the bound would predict no gain here and end the optimisation."""
    collinear = SLOPES + np.array([3.0, 0.0, 3.0]) * SLOPES[:, 1:2]
    target = Target({"lv_volume": Samples(np.arange(12.0), collinear @ np.array([0.6, -1.5, 1.0]))}, NOISE)
    lower = np.array([-np.inf, 0.0, -np.inf])
    stacked, values = np.vstack([collinear / 0.05, np.eye(3)]), np.append(target.values() / 0.05, np.zeros(3))
    best = lsq_linear(stacked, values, (lower, np.full(3, np.inf))).x
    start = best + np.array([0.0, 0.5, 0.0])
    walk = walked(started(lambda x: collinear @ x, collinear, lower, target, start))
    assert walk.converged
    assert best[1] == pytest.approx(0.0, abs=1e-6)
    assert walk.x == pytest.approx(best, abs=0.01)


def test_no_step_is_longer_than_the_slopes_are_valid() -> None:
    walk = started(lambda x: 0.1 * linear(x), 0.1 * SLOPES)
    walk.advance()
    assert np.abs(walk.x).max() <= LONGEST_STEP


def test_a_failed_beat_only_shortens_the_step() -> None:
    points: list[Floats] = []

    def failing(x: Floats) -> Floats | None:
        points.append(x)
        return linear(x) if np.abs(x).max() < 0.5 else None

    walk = started(failing)
    walk.advance()
    assert not walk.x.any()
    assert np.array_equal(walk.jacobian, SLOPES)
    walked(walk)
    assert 0.0 < np.abs(walk.x).max() < 0.5
    assert not walk.converged, "the optimisation has not converged"
