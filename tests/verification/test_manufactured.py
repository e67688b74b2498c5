"""The formulas of the manufactured deformation against each other: each is the derivative of the one before."""

import numpy as np
import pytest

from heartfit.heart.finite_elements.assembly import add_stresses
from heartfit.heart.finite_elements.kinematics import COLUMN, ROW, VOIGT, fibre_dyads
from heartfit.heart.muscle.passive import MooneyRivlin
from tests.shrinking import assert_derivative
from verification.block import FIBRE, Manufactured

STEP = 1e-30


@pytest.fixture
def problem() -> Manufactured:
    return Manufactured(MooneyRivlin(K=3e4))


@pytest.fixture
def X() -> np.ndarray:
    return 0.02 * np.random.default_rng(3).random((3, 5))


def energy(problem: Manufactured, F: np.ndarray) -> np.ndarray:
    """Mooney-Rivlin energy (...,) plus that of the fibres at constant tension, of F (..., 3, 3)."""
    C, J = np.swapaxes(F, -1, -2) @ F, np.linalg.det(F)
    first = np.trace(C, axis1=-2, axis2=-1)
    second = 0.5 * (first**2 - np.trace(C @ C, axis1=-2, axis2=-1))
    m = problem.material
    passive = m.c_1 * (first * J ** (-2 / 3) - 3.0) + m.c_2 * (second * J ** (-4 / 3) - 3.0)
    fibres = 0.5 * problem.sigma * np.einsum("i,...ij,j->...", FIBRE, C, FIBRE)
    return passive + 0.5 * m.K * (J - 1.0) ** 2 + fibres


def test_the_gradient_is_that_of_the_position(problem, X):
    F = problem.deformation_gradient(X)
    for j in range(3):
        shifted = X.astype(complex)
        shifted[j] += 1j * STEP
        assert F[:, j] == pytest.approx(problem.position(shifted).imag / STEP, abs=1e-14)


def test_only_the_stretch_changes_volumes_by_the_pressure_over_K(problem, X):
    J = np.linalg.det(np.moveaxis(problem.deformation_gradient(X), -1, 0))
    assert pytest.approx(1.0 + problem.pressure(X) / problem.material.K, rel=1e-12) == J


def test_the_stress_is_the_derivative_of_the_energy(problem, X):
    F = problem.deformation_gradient(X)
    P = problem.stress(F)
    for i, j in np.ndindex(3, 3):
        shifted = np.moveaxis(F, -1, 0).astype(complex)
        shifted[:, i, j] += 1j * STEP
        assert P[i, j] == pytest.approx(energy(problem, shifted).imag / STEP, rel=1e-10, abs=1e-7)


def test_the_stress_is_that_of_the_wall_point_by_point(problem, X):
    """A spherical stress that is wrong by a constant moves nothing in a clamped block; here it shows."""
    F = np.moveaxis(problem.deformation_gradient(X), -1, 0)
    C, J = (np.swapaxes(F, -1, -2) @ F)[:, ROW, COLUMN], np.linalg.det(F)
    S = np.empty_like(C)
    problem.material.stress(C, J, np.ones(len(F)), np.empty_like(C), S)
    tension, dyads = np.full(len(F), problem.sigma), np.repeat(fibre_dyads(FIBRE[None]), len(F), axis=0)
    add_stresses(C, J, problem.pressure(X), C, C, 0.0, 0.0, tension, dyads, S)
    assert problem.stress(problem.deformation_gradient(X)) == pytest.approx(
        np.moveaxis(F @ S[:, VOIGT], 0, -1), rel=1e-10, abs=1e-7
    )


def test_the_force_balances_the_divergence_of_the_stress(problem, X):
    def stress_columns(place: np.ndarray) -> np.ndarray:
        return np.stack([problem.stress(problem.deformation_gradient(p))[:, j] for j, p in enumerate(place)])

    moves = 1e-3 * np.eye(3)[:, :, None] * np.ones_like(X)

    def along(places: np.ndarray) -> np.ndarray:
        return stress_columns(places).sum(axis=0)

    assert_derivative(along, -1e-3 * problem.force(X), np.stack([X] * 3), moves)
