"""The exponential law against its energy, written in the axes of the fibre."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.heart.finite_elements.body import Tissue
from heartfit.heart.finite_elements.kinematics import COLUMN, ROW, fibre_dyads
from heartfit.heart.muscle.guccione import Guccione
from heartfit.heart.sphere.body import Sphere, SphericalBody
from tests.shrinking import assert_derivative

LAW = Guccione(C=3e3, b_f=7.0, b_t=2.5, b_fs=1.5)
SCALE = 1.7


def axes(fibre: np.ndarray) -> np.ndarray:
    """An orthogonal matrix whose first row is the fibre."""
    Q, _ = np.linalg.qr(np.column_stack([fibre, np.eye(3)[:, :2]]))
    return Q.T * np.sign(Q[:, 0] @ fibre)


def energy(C: np.ndarray, fibre: np.ndarray) -> np.ndarray:
    isochoric = np.linalg.det(C) ** (-1 / 3) * C
    E = 0.5 * axes(fibre) @ (isochoric - np.eye(3)) @ axes(fibre).T
    across = E[1, 1] ** 2 + E[2, 2] ** 2 + E[1, 2] ** 2 + E[2, 1] ** 2
    shear = E[0, 1] ** 2 + E[1, 0] ** 2 + E[0, 2] ** 2 + E[2, 0] ** 2
    exponent = LAW.b_f * E[0, 0] ** 2 + LAW.b_t * across + LAW.b_fs * shear
    return SCALE * 0.5 * LAW.C * np.array(np.expm1(exponent))


def arguments(C: np.ndarray, fibre: np.ndarray) -> tuple[np.ndarray, ...]:
    return C[ROW, COLUMN][None], np.sqrt(np.linalg.det(C))[None], np.array([SCALE]), fibre_dyads(fibre[None])


def stress(C: np.ndarray, fibre: np.ndarray) -> np.ndarray:
    S = np.empty((1, 6))
    LAW.stress(*arguments(C, fibre), S)
    return S[0]


def tangent(C: np.ndarray, fibre: np.ndarray) -> np.ndarray:
    D = np.empty((1, 6, 6))
    LAW.tangent(*arguments(C, fibre), D)
    return D[0]


def engineering_strain(dC: np.ndarray) -> np.ndarray:
    """Six-vector of dE = dC/2 with its shears doubled."""
    return dC[ROW, COLUMN] * np.array([0.5, 0.5, 0.5, 1.0, 1.0, 1.0])


@pytest.fixture(params=range(10))
def state(request: pytest.FixtureRequest) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A random deformation, a direction and a fibre."""
    rng = np.random.default_rng(request.param)
    F = np.eye(3) + 0.2 * rng.standard_normal((3, 3))
    H, fibre = rng.standard_normal((3, 3)), rng.standard_normal(3)
    return F.T @ F, 0.01 * (H + H.T), fibre / np.linalg.norm(fibre)


def test_stress_is_the_derivative_of_the_energy(state) -> None:
    C, dC, fibre = state
    assert_derivative(lambda C: energy(C, fibre), np.array(stress(C, fibre) @ engineering_strain(dC)), C, dC)


def test_tangent_is_the_derivative_of_the_stress(state) -> None:
    C, dC, fibre = state
    D = tangent(C, fibre)
    assert_derivative(lambda C: stress(C, fibre), D @ engineering_strain(dC), C, dC)
    assert pytest.approx(D.T, rel=1e-12, abs=1e-9 * abs(D).max()) == D


def test_shear_moduli_at_rest_are_those_of_the_exponents() -> None:
    D = tangent(np.eye(3), np.array([1.0, 0.0, 0.0])) / (SCALE * LAW.C)
    assert np.diag(D)[3:] == pytest.approx(0.5 * np.array([LAW.b_fs, LAW.b_fs, LAW.b_t]))


def test_there_is_no_stress_at_rest_and_under_pure_dilation() -> None:
    for C in (np.eye(3), 1.3 * np.eye(3)):
        assert stress(C, np.array([0.6, 0.0, 0.8])) == pytest.approx(np.zeros(6), abs=1e-9)


def test_the_spheres_refuse_a_law_with_directions() -> None:
    with pytest.raises(InputError, match=r"isotropic.*Guccione"):
        SphericalBody(Sphere(0.03, 0.01), Sphere(0.03, 0.01), Tissue(passive=LAW))
