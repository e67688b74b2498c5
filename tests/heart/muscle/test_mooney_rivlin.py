"""The passive law against an energy written down independently of it."""

import numpy as np
import pytest

from heartfit.heart.finite_elements.kinematics import COLUMN, ROW
from heartfit.heart.muscle.passive import MooneyRivlin
from tests.shrinking import assert_derivative

LAW = MooneyRivlin(c_1=5e3, c_2=8e2)
SCALE = 1.7
REST = np.eye(3)


def energy(C: np.ndarray) -> np.ndarray:
    """Isochoric energy of the full tensor (3, 3)."""
    J = np.sqrt(np.linalg.det(C))
    I1, I2 = np.trace(C), 0.5 * (np.trace(C) ** 2 - np.trace(C @ C))
    return SCALE * np.array(LAW.c_1 * (J ** (-2 / 3) * I1 - 3.0) + LAW.c_2 * (J ** (-4 / 3) * I2 - 3.0))


def arguments(C: np.ndarray) -> tuple[np.ndarray, ...]:
    return C[ROW, COLUMN][None], np.sqrt(np.linalg.det(C))[None], np.array([SCALE]), np.empty((1, 6))


def stress(C: np.ndarray) -> np.ndarray:
    S = np.empty((1, 6))
    LAW.stress(*arguments(C), S)
    return S[0]


def tangent(C: np.ndarray) -> np.ndarray:
    D = np.empty((1, 6, 6))
    LAW.tangent(*arguments(C), D)
    return D[0]


def engineering_strain(dC: np.ndarray) -> np.ndarray:
    """Six-vector of dE = dC/2 with its shears doubled."""
    return dC[ROW, COLUMN] * np.array([0.5, 0.5, 0.5, 1.0, 1.0, 1.0])


@pytest.fixture(params=range(10))
def state(request: pytest.FixtureRequest) -> tuple[np.ndarray, np.ndarray]:
    """A random deformation, far from rest and not isochoric, and a direction."""
    rng = np.random.default_rng(request.param)
    F = REST + 0.25 * rng.standard_normal((3, 3))
    H = rng.standard_normal((3, 3))
    return F.T @ F, 0.01 * (H + H.T)


def test_stress_is_the_derivative_of_the_energy(state: tuple[np.ndarray, np.ndarray]) -> None:
    C, dC = state
    assert_derivative(energy, np.array(stress(C) @ engineering_strain(dC)), C, dC)


def test_tangent_is_the_derivative_of_the_stress(state: tuple[np.ndarray, np.ndarray]) -> None:
    C, dC = state
    assert_derivative(stress, tangent(C) @ engineering_strain(dC), C, dC)


def test_tangent_is_symmetric(state: tuple[np.ndarray, np.ndarray]) -> None:
    D = tangent(state[0])
    assert pytest.approx(D.T, rel=1e-12, abs=1e-9 * abs(D).max()) == D


def test_there_is_no_stress_at_rest_and_under_pure_dilation() -> None:
    assert stress(REST) == pytest.approx(np.zeros(6), abs=1e-9)
    assert stress(1.3 * REST) == pytest.approx(np.zeros(6), abs=1e-9)


def test_small_shear_meets_twice_the_sum_of_both_moduli() -> None:
    assert LAW.shear_modulus == 2.0 * (5e3 + 8e2)
    assert tangent(REST)[3, 3] == pytest.approx(SCALE * LAW.shear_modulus)


@pytest.mark.parametrize("stretch", [0.7, 1.0, 1.15, 1.6])
def test_in_plane_functions_derive_from_the_equibiaxial_energy(stretch: float) -> None:
    def equibiaxial(x: np.ndarray) -> np.ndarray:
        return energy(np.diag([x[0] ** 2, x[0] ** 2, x[0] ** -4])) / SCALE

    x, dx = np.array([stretch]), np.array([0.02])
    stress, stiffness = LAW.in_plane_stress(x), LAW.in_plane_stiffness(x)
    if stretch == 1.0:
        assert stress == pytest.approx(0.0, abs=1e-9)
    else:
        assert_derivative(equibiaxial, stress[0] * 0.02, x, dx)
    assert_derivative(LAW.in_plane_stress, stiffness * dx, x, dx)
