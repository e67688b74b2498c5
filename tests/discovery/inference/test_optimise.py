"""Linear problems take one step; bounds, failures and reused slopes do not stop the other coordinates."""

import numpy as np
import pytest

from heartfit.discovery.inference.data import Noise, Whitening
from heartfit.discovery.inference.evidence import OBJECTIVE_TOLERANCE, fit
from heartfit.discovery.inference.hypothesis import Coordinate, CountedHypothesis, Hypothesis
from tests.discovery.inference import oscillator
from tests.discovery.inference.linear import NOISE, TIMES, data, hypothesis, slopes

KNOWN = Noise((0.3,), NOISE.memory, NOISE.roughness, NOISE.discrepancy)
Y = slopes(3) @ np.array([1.0, -2.0, 0.5]) + 0.1 * np.random.default_rng(2).standard_normal(TIMES.size)


def fitted(tested: Hypothesis, start: np.ndarray, values: np.ndarray = Y) -> tuple[object, int]:
    model = CountedHypothesis(tested)
    return fit(model, values, Whitening.from_data(data(values, KNOWN)), start), model.runs


def ridge(J: np.ndarray) -> np.ndarray:
    noise = KNOWN.covariance(TIMES, 1.0, 0.3)
    return np.linalg.solve(
        np.eye(J.shape[1]) + J.T @ np.linalg.solve(noise, J), J.T @ np.linalg.solve(noise, Y)
    )


def test_a_linear_problem_is_solved_by_a_damped_step_and_full_ones() -> None:
    """One run at the start, three for the slopes before and after, and the steps between."""
    optimum, runs = fitted(hypothesis(slopes(3)), np.zeros(3))
    assert optimum.converged
    assert optimum.x == pytest.approx(ridge(slopes(3)), abs=1e-2)
    assert runs <= 1 + 2 * 3 + 2


def test_a_bound_holds_and_other_coordinates_are_optimal_beside_it() -> None:
    J = slopes(3)
    away = hypothesis(J * [1.0, 1.0, -1.0], Coordinate("a", one_sided=True, amplitude=True))
    optimum, _ = fitted(away, away.at(1.0))
    assert optimum.converged
    assert optimum.x[2] == 0.0
    assert optimum.x[:2] == pytest.approx(ridge(J[:, :2]), abs=1e-2)


def test_failures_shorten_the_step_and_the_start() -> None:
    """A model that fails beyond |x| = 2.3 reaches its optimum inside from a start outside."""
    linear = hypothesis(slopes(3))
    failing = Hypothesis(
        (), linear.coordinates, lambda x: linear.forward(x) if np.linalg.norm(x) < 2.3 else None
    )
    optimum, _ = fitted(failing, np.array([3.0, 0.0, 0.0]))
    assert optimum.converged
    assert optimum.objective == pytest.approx(
        fitted(linear, np.zeros(3))[0].objective, abs=OBJECTIVE_TOLERANCE
    )


def test_a_model_that_never_runs_has_no_fit() -> None:
    dead = Hypothesis((), hypothesis(slopes(2)).coordinates, lambda x: None)
    assert fitted(dead, np.ones(2))[0] is None


def test_reused_slopes_lead_to_the_same_optimum_with_fewer_runs() -> None:
    truth = oscillator.observed(oscillator.curves(np.array([1.0, 0.5, -1.0, 0.3])), 1)
    whitening, cost = Whitening.from_data(truth), []
    at_centre = CountedHypothesis(oscillator.NONE).jacobian(np.zeros(4), oscillator.curves(np.zeros(4)))
    for start_slopes in (None, at_centre):
        model = CountedHypothesis(oscillator.NONE)
        optimum = fit(model, truth.values, whitening, np.zeros(4), start_slopes)
        cost.append((model.runs, optimum.objective))
        assert optimum.converged
    assert cost[1][0] < cost[0][0]
    assert cost[1][1] == pytest.approx(cost[0][1], abs=0.05)


def test_trusted_slopes_are_reused() -> None:
    J = slopes(3)
    model = CountedHypothesis(hypothesis(J))
    optimum = fit(model, Y, Whitening.from_data(data(Y, KNOWN)), np.zeros(3), J, trusted=2)
    assert optimum.x == pytest.approx(ridge(J), abs=1e-2)
    assert model.runs <= 1 + 1 + 2


def test_a_fit_that_cannot_reach_its_target_ends_with_its_first_new_slopes() -> None:
    whole, runs = fitted(hypothesis(slopes(3)), np.zeros(3))
    for above, ended in ((0.1, True), (-0.1, False)):
        model = CountedHypothesis(hypothesis(slopes(3)))
        optimum = fit(
            model, Y, Whitening.from_data(data(Y, KNOWN)), np.zeros(3), target=whole.objective + above
        )
        assert optimum.converged == ended
        assert model.runs == (runs if ended else 1 + 3)
