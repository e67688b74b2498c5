"""The factorisation: any symmetric matrix of the mesh's pattern that is positive in u and negative in p."""

from collections.abc import Callable

import numpy as np
import pytest

from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.heart.finite_elements.solver import Elimination
from tests.heart.conftest import assembled


def saddles(mesh: VentricularMesh, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Random symmetric indefinite element matrices (m, 16, 16) and nodal blocks (n, 4, 4)."""
    rng = np.random.default_rng(seed)
    sign = np.tile([1.0, 1.0, 1.0, -1.0], 4)

    def quasidefinite(count: int, sign: np.ndarray) -> np.ndarray:
        G = rng.standard_normal((count, sign.size, sign.size))
        definite = G @ G.swapaxes(1, 2) + np.eye(sign.size)
        keep = 0.5 * (sign[:, None] + sign) != 0.0
        coupling = rng.standard_normal(definite.shape)
        return np.where(keep, definite * sign[:, None], coupling + coupling.swapaxes(1, 2))

    return quasidefinite(len(mesh.tets), sign), quasidefinite(len(mesh.points), sign[:4])


@pytest.mark.parametrize("make", ["symmetric", "general"])
@pytest.mark.parametrize("seed", range(3))
def test_solves_to_single_precision(block: Callable, seed: int, make: str) -> None:
    mesh = block((2, 3, 2), seed)
    elements, nodes = saddles(mesh, seed)
    n = len(mesh.points)
    elimination = Elimination(mesh.tets, n, 4)
    if make == "general":
        elements += 0.2 * np.random.default_rng(seed).standard_normal(elements.shape)
        nodes += 0.2 * np.random.default_rng(seed).standard_normal(nodes.shape)
    factor = elimination.factorise(elements, nodes, symmetric=make == "symmetric")
    dense = assembled(mesh.tets, elements, nodes)
    values = np.linalg.svd(dense, compute_uv=False)
    assert values[0] < 1e4 * values[-1]
    solution = np.random.default_rng(seed).standard_normal(4 * n)
    assert factor.solve(dense @ solution) == pytest.approx(solution, abs=1e-6 * values[0] / values[-1])


def test_the_matrix_is_indefinite(block: Callable) -> None:
    mesh = block((2, 3, 2))
    eigenvalues = np.linalg.eigvalsh(assembled(mesh.tets, *saddles(mesh, 0)))
    assert eigenvalues[0] < 0.0 < eigenvalues[-1]


def test_columns_are_solved_one_by_one(block: Callable) -> None:
    mesh = block()
    elements, nodes = saddles(mesh, 5)
    elements[:, 0] += 1.0  # no longer symmetric
    factor = Elimination(mesh.tets, len(mesh.points), 4).factorise(elements, nodes, symmetric=False)
    right = np.random.default_rng(5).standard_normal((4 * len(mesh.points), 3))
    columns = np.stack([factor.solve(column) for column in right.T], axis=1)
    assert factor.solve(right) == pytest.approx(columns, rel=1e-5, abs=1e-7)


@pytest.mark.parametrize("bad", [0.0, np.nan])
def test_a_tangent_without_factors_is_a_stated_failure(block: Callable, bad: float) -> None:
    mesh = block()
    elements, nodes = (bad * matrix for matrix in saddles(mesh, 5))
    elimination = Elimination(mesh.tets, len(mesh.points), 4)
    with pytest.raises(StepFailed, match="cannot be factorised"):
        elimination.factorise(elements, nodes)


def test_a_singular_general_tangent_is_a_stated_failure(block: Callable) -> None:
    mesh = block()
    elements, nodes = saddles(mesh, 5)
    elimination = Elimination(mesh.tets, len(mesh.points), 4)
    with pytest.raises(StepFailed, match="cannot be factorised"):
        elimination.factorise(np.ones_like(elements), np.zeros_like(nodes), symmetric=False)
