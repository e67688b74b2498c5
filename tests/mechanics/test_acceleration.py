"""Anderson's method is a Krylov method where the iteration is linear."""

import numpy as np
import pytest

from heartfit.mechanics.acceleration import DEPTH, Anderson


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("n", [1, 2, 4, DEPTH])
def test_a_linear_problem_is_solved_in_one_step_more_than_unknowns(n: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    A, solution = rng.standard_normal((n, n)), rng.standard_normal(n)
    anderson, z = Anderson(rng.uniform(0.5, 2.0, n)), np.zeros(n)
    for _ in range(n + 1):
        z = z + anderson.mix(z, A @ (z - solution) - (z - solution))
    assert z == pytest.approx(solution, abs=1e-6 * np.abs(solution).max())


def test_what_is_forgotten_does_not_mix() -> None:
    anderson, z = Anderson(np.ones(3)), np.zeros(3)
    for _ in range(3):
        z = z + anderson.mix(z, np.ones(3) - 0.3 * z**2)
    anderson.forget()
    change = np.array([1.0, 2.0, 3.0])
    assert (anderson.mix(z, change) == change).all()
