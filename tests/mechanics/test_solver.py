"""The factorisation: any symmetric matrix of the mesh's pattern that is positive in u and negative in p."""

from collections.abc import Callable

import numpy as np
import pytest

from heartfit.geometry.mesh import VentricularMesh
from heartfit.mechanics.assembly import SparsityPattern
from heartfit.mechanics.solver import Factor, nested_dissection


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


def scattered(mesh: VentricularMesh, elements: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """The same matrix summed entry by entry."""
    dense = np.zeros((4 * len(mesh.points),) * 2)
    for tet, matrix in zip(mesh.tets, elements, strict=True):
        rows = (4 * tet[:, None] + np.arange(4)).ravel()
        dense[np.ix_(rows, rows)] += matrix
    for n, matrix in enumerate(nodes):
        dense[4 * n : 4 * n + 4, 4 * n : 4 * n + 4] += matrix
    return dense


@pytest.mark.parametrize("seed", range(3))
def test_solves_to_single_precision(block: Callable, seed: int) -> None:
    mesh = block((2, 3, 2), seed)
    elements, nodes = saddles(mesh, seed)
    n = len(mesh.points)
    pattern = SparsityPattern(mesh.tets, n, 4, nested_dissection(mesh.tets, n))
    dense = scattered(mesh, elements, nodes)
    eigenvalues = np.linalg.eigvalsh(dense)
    assert eigenvalues[0] < 0.0 < eigenvalues[-1]
    factor = Factor(pattern.assemble(elements, nodes), pattern.permutation)
    solution = np.random.default_rng(seed).standard_normal((4 * n, 2))
    condition = abs(eigenvalues).max() / abs(eigenvalues).min()
    assert condition < 1e4
    assert factor.solve(dense @ solution) == pytest.approx(solution, abs=10 * condition * 6e-8)
    assert factor.solve(dense @ solution[:, 0]) == pytest.approx(factor.solve(dense @ solution)[:, 0])


def test_the_elimination_order_is_a_permutation(block: Callable) -> None:
    mesh = block((4, 3, 2))
    order = nested_dissection(mesh.tets, len(mesh.points))
    assert sorted(order) == list(range(len(mesh.points)))
