"""A block of tissue whose faces play the ventricles' surfaces, and the tangent of a step as a matrix."""

from collections.abc import Callable

import numpy as np
import pytest
from skfem import MeshTet

from heartfit.geometry.mesh import VentricularMesh, element_volumes
from heartfit.geometry.surface import boundary_faces
from heartfit.heart.finite_elements.body import Step

EDGE = 0.04
Block = Callable[..., VentricularMesh]


def _side(points: np.ndarray, faces: np.ndarray, axis: int, value: float) -> np.ndarray:
    return (abs(points[faces][:, :, axis] - value) < 1e-9).all(axis=1)


@pytest.fixture(scope="session")
def block() -> Block:
    """Cuboids with irregular inner nodes and random fibres: base x = 0, cavities at z = 0 and at the top."""

    def build(cells: tuple[int, int, int] = (3, 3, 3), seed: int = 0) -> VentricularMesh:
        rng, sides = np.random.default_rng(seed), EDGE / 3.0 * np.array(cells)
        grid = MeshTet.init_tensor(*(np.linspace(0.0, s, n + 1) for s, n in zip(sides, cells, strict=True)))
        points, tets = grid.p.T.copy(), grid.t.T.astype(np.int64)
        inner = ((points > 1e-9) & (points < sides - 1e-9)).all(axis=1)
        points[inner] += 0.1 * EDGE / 3.0 * rng.standard_normal((inner.sum(), 3))
        negative = element_volumes(points, tets) < 0.0
        tets[negative] = tets[negative][:, [0, 2, 1, 3]]
        return _named(points, tets, sides, rng)

    return build


def _named(
    points: np.ndarray, tets: np.ndarray, sides: np.ndarray, rng: np.random.Generator
) -> VentricularMesh:
    faces = boundary_faces(tets)
    base, left = _side(points, faces, 0, 0.0), _side(points, faces, 2, 0.0)
    right = _side(points, faces, 2, sides[2])
    fibres = rng.standard_normal((len(tets), 3))
    return VentricularMesh(
        points,
        tets,
        {
            "base": faces[base],
            "lv_endo": faces[left],
            "rv_endo": faces[right],
            "epi": faces[~(base | left | right)],
        },
        fibres=fibres / np.linalg.norm(fibres, axis=1, keepdims=True),
        activation=rng.uniform(0.0, 0.05, len(tets)),
        longitudinal=1.0 - points[:, 0] / sides[0],
    )


@pytest.fixture
def tangent_matrix() -> Callable[[Step, np.ndarray], np.ndarray]:
    """The dense tangent (N, N) of a step."""

    def evaluate(step: Step, x: np.ndarray) -> np.ndarray:
        for _ in range(2):  # the slope of the fibres is that of their last but one iteration
            step.forces(x)
        return assembled(step.body.tets, *step.stiffness(x))

    return evaluate


def assembled(tets: np.ndarray, elements: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """The sum (n d, n d) of element matrices (m, 4 d, 4 d) and nodal blocks (n, d, d)."""
    n, d = nodes.shape[:2]
    dense = np.zeros((n * d, n * d))
    for tet, matrix in zip(tets, elements, strict=True):
        rows = (d * tet[:, None] + np.arange(d)).ravel()
        dense[np.ix_(rows, rows)] += matrix
    for i, matrix in enumerate(nodes):
        dense[d * i : d * i + d, d * i : d * i + d] += matrix
    return dense
