"""Cube of regular tetrahedra as a mesh of the wall, and bare meshes of other regular shapes."""

import numpy as np
from skfem import MeshTet

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh, element_volumes
from heartfit.geometry.surface import boundary_faces

FIBRE = np.array([2.0, 1.0, 2.0]) / 3.0
"""Unit fibre direction of the cube, along none of its edges."""


def cube(n: int, L: float) -> VentricularMesh:
    """Mesh of a cube of edge ``L`` [m], ``n`` elements along an edge; its floor and lid have the names of cavities."""
    grid = MeshTet.init_tensor(*[np.linspace(0.0, L, n + 1)] * 3)
    points, tets = np.ascontiguousarray(grid.p.T), grid.t.T.astype(np.int64, order="C")
    tets = oriented(points, tets)
    shell = boundary_faces(tets)
    centres = points[shell].mean(axis=1)
    surfaces = {
        name: shell[np.isclose(centres[:, axis], position)]
        for name, (axis, position) in sides_of_cube(L).items()
    }
    return bare_mesh(points, tets, surfaces, np.tile(FIBRE, (len(tets), 1)))


def sides_of_cube(L: float) -> dict[str, tuple[int, float]]:
    """Axis and position [m] of each named side of a cube of edge ``L`` [m]."""
    return {"lv_endo": (2, 0.0), "rv_endo": (2, L), "base": (0, 0.0), "epi": (0, L)}


def oriented(points: Floats, tets: Integers) -> Integers:
    """Tetrahedra (t, 4) with positive volumes."""
    mirrored = element_volumes(points, tets) < 0.0
    return np.where(mirrored[:, None], tets[:, [0, 2, 1, 3]], tets)


def bare_mesh(
    points: Floats, tets: Integers, surfaces: dict[str, Integers], fibres: Floats
) -> VentricularMesh:
    """Mesh that is activated at time 0 everywhere and has no longitudinal coordinate."""
    return VentricularMesh(points, tets, surfaces, fibres, None, np.zeros(len(tets)), np.zeros(len(points)))
