"""Anderson's method is a Krylov method where the iteration is linear."""

import numpy as np
import pytest

from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.heart.time_step import ANDERSON_DEPTH, Anderson


@pytest.mark.parametrize("n", [1, 2, 4, ANDERSON_DEPTH])
def test_a_linear_problem_is_solved_in_one_step_more_than_unknowns(n: int) -> None:
    for seed in range(10):
        rng = np.random.default_rng(seed)
        A, solution = rng.standard_normal((n, n)), rng.standard_normal(n)
        anderson, z = Anderson(rng.uniform(0.5, 2.0, n)), np.zeros(n)
        for _ in range(n + 1):
            z = z + anderson.mix(z, A @ (z - solution) - (z - solution))
        assert z == pytest.approx(solution, abs=1e-6 * np.abs(solution).max()), seed


def test_forgotten_changes_are_not_mixed() -> None:
    anderson, z = Anderson(np.ones(3)), np.zeros(3)
    for _ in range(3):
        z = z + anderson.mix(z, np.ones(3) - 0.3 * z**2)
    anderson.forget()
    change = np.array([1.0, 2.0, 3.0])
    assert (anderson.mix(z, change) == change).all()


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_change_that_is_not_finite_is_a_stated_failure(bad: float) -> None:
    anderson, z = Anderson(np.ones(3)), np.zeros(3)
    anderson.mix(z, np.ones(3))
    with pytest.raises(StepFailed, match="1 of 3 unknowns, unknown 1 first, is not finite"):
        anderson.mix(z, np.array([1.0, bad, 3.0]))


def test_changes_too_large_to_mix_are_a_stated_failure() -> None:
    anderson, z = Anderson(np.full(3, 1e10)), np.zeros(3)
    anderson.mix(z, np.ones(3))
    with pytest.raises(StepFailed, match="mix of the last 1 changes"), np.errstate(over="ignore"):
        anderson.mix(z, np.array([1.0, 1e305, 3.0]))


def test_equal_changes_are_mixed_though_they_are_singular() -> None:
    anderson, z = Anderson(np.ones(3)), np.zeros(3)
    for _ in range(ANDERSON_DEPTH):
        assert (anderson.mix(z, np.ones(3)) == 1.0).all()
