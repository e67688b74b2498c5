"""Minimiser: it reaches the minimum of a quadratic, and no step increases the objective."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import pytest

from heartfit.imaging.registration.terms import Linearised
from heartfit.imaging.registration.track import minimise


@dataclass
class Squares:
    """Objective |r(x)|^2 with the residual r and its Jacobian; it records its values."""

    residual: Callable[[np.ndarray], np.ndarray]
    jacobian: Callable[[np.ndarray], np.ndarray]
    values: list[float] = field(default_factory=list)

    def linearise(self, coefficients: np.ndarray) -> Linearised:
        r, J = self.residual(coefficients.ravel()), self.jacobian(coefficients.ravel())
        self.values.append(float(r @ r))
        shape = coefficients.shape

        def curvature(step: np.ndarray) -> np.ndarray:
            return (J.T @ (J @ step.ravel())).reshape(shape)

        return Linearised(
            float(r @ r), -(J.T @ r).reshape(shape), curvature, (J**2).sum(axis=0).reshape(shape)
        )


def line(matrix: np.ndarray, target: np.ndarray) -> Squares:
    return Squares(lambda x: matrix @ x - target, lambda x: matrix)


@pytest.mark.parametrize("seed", range(3))
def test_the_minimum_of_a_quadratic_is_found(seed: int) -> None:
    """Compared with least squares of both terms."""
    rng = np.random.default_rng(seed)
    first, second = rng.standard_normal((2, 9, 6))
    b, c = rng.standard_normal((2, 9))
    expected = np.linalg.lstsq(np.vstack([first, second]), np.concatenate([b, c]), rcond=None)[0]
    minimum = minimise([line(first, b), line(second, c)], np.zeros((2, 3), np.float32), 10)
    assert minimum.ravel() == pytest.approx(expected, abs=2e-3)


def test_a_diagonal_quadratic_takes_one_step() -> None:
    scale = np.array([1e-2, 1.0, 30.0, 1e3])
    minimum = minimise([line(np.diag(scale), scale * [1.0, -2.0, 3.0, 4.0])], np.zeros((4,), np.float32), 1)
    assert minimum == pytest.approx(np.array([1.0, -2.0, 3.0, 4.0]), rel=1e-5)


def test_coefficients_outside_all_terms_stay() -> None:
    """A knot of the lattice beyond the images."""
    matrix = np.diag([1.0, 0.0, 2.0])
    minimum = minimise([line(matrix, np.array([3.0, 0.0, 4.0]))], np.full((3,), 7.0, np.float32), 5)
    assert minimum == pytest.approx(np.array([3.0, 7.0, 2.0]), rel=1e-5)


@pytest.mark.parametrize("start", [0.5, 1.5, 3.0, 10.0, 100.0])
def test_the_objective_never_increases(start: float) -> None:
    """On atan(x)^2, whose whole steps leap over the minimum and away from it beyond x = 1.39."""
    steep = Squares(np.arctan, lambda x: np.diag(1.0 / (1.0 + x**2)))
    x, values = np.array([start, -start]), []
    for _ in range(10):
        values.append(steep.linearise(x).value)
        x = minimise([steep], x, 1)
    assert (np.diff(values) <= 0.0).all()
    if start <= 3.0:
        assert values[-1] < 1e-6


def test_steps_are_as_many_as_asked_at_most() -> None:
    cubic = Squares(lambda x: x**3, lambda x: np.diag(3.0 * x**2))
    x = minimise([cubic], np.full((1,), 8.0), 3)
    assert x == pytest.approx([8.0 * (2.0 / 3.0) ** 3], rel=1e-5)


def test_the_minimisation_stops_without_improvement() -> None:
    flat = line(np.eye(3), np.zeros(3))
    flat.residual = lambda x: np.concatenate([x, [1.0]])
    flat.jacobian = lambda x: np.vstack([np.eye(3), np.zeros(3)])
    minimise([flat], np.full((3,), 1e-2), 50)
    assert len(flat.values) <= 3
