"""Kinematics: six-vectors against full tensors, and linear maps against the gradients of linear tetrahedra."""

from collections.abc import Callable

import numpy as np
import pytest

from heartfit.heart.finite_elements import kinematics
from heartfit.heart.finite_elements.kinematics import COLUMN, ROW, StepFailed


def random_tensor(seed: int) -> np.ndarray:
    G = np.eye(3) + 0.3 * np.random.default_rng(seed).standard_normal((3, 3))
    return G.T @ G


@pytest.mark.parametrize("seed", range(5))
def test_inverse_and_symmetric_product_are_those_of_the_tensor(seed: int) -> None:
    A, X = random_tensor(seed), random_tensor(seed + 50)
    six = np.empty(6)
    kinematics.inverse(A[ROW, COLUMN], np.linalg.det(A), six)
    assert six == pytest.approx(np.linalg.inv(A)[ROW, COLUMN])
    double = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0]) * X[ROW, COLUMN]
    product = [
        sum(kinematics.symmetric_product(A[ROW, COLUMN], i, j) * double[j] for j in range(6))
        for i in range(6)
    ]
    assert product == pytest.approx((A @ X @ A)[ROW, COLUMN])


def test_a_linear_map_has_its_own_gradient_stretch_and_fibre_strain(block: Callable) -> None:
    mesh, F = block(), np.eye(3) + 0.2 * np.random.default_rng(1).standard_normal((3, 3))
    gradients, volumes = kinematics.shape_gradients(mesh.points, mesh.tets)
    assert volumes.sum() == pytest.approx(0.04**3)
    m = len(mesh.tets)
    gradient, C, J = np.empty((m, 3, 3)), np.empty((m, 6)), np.empty(m)
    kinematics.deformation_gradient(mesh.points @ (F - np.eye(3)).T, mesh.tets, gradients, gradient)
    kinematics.right_cauchy_green(gradient, C, J)
    assert gradient == pytest.approx(np.broadcast_to(F, gradient.shape))
    assert pytest.approx(np.broadcast_to((F.T @ F)[ROW, COLUMN], C.shape)) == C
    assert pytest.approx(np.linalg.det(F)) == J
    strain = kinematics.fibre_strain(C, kinematics.fibre_dyads(mesh.fibres))
    assert strain == pytest.approx(0.5 * (np.linalg.norm(mesh.fibres @ F.T, axis=1) ** 2 - 1.0))


def test_a_tetrahedron_without_positive_volume_is_named(block: Callable) -> None:
    mesh = block()
    tets = mesh.tets.copy()
    tets[7] = tets[7][[1, 0, 2, 3]]
    with pytest.raises(StepFailed, match=r"tetrahedron 7\b.*-\S+ m\^3"):
        kinematics.shape_gradients(mesh.points, tets)
