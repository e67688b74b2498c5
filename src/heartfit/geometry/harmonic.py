"""Harmonic fields on tetrahedra, and directions in the wall.

Directions in the wall are gradients of harmonic fields. On a coarse mesh the gradient vanishes within a tetrahedron
whose four nodes lie on one level of its field. If three nodes lie on a level of two fields, as at the rim of the apical
patch, both gradients are parallel and span no plane. Only rounding would set a direction there, so the mean of the
neighbouring tetrahedra replaces it.
"""

import numpy as np
from scipy.sparse.linalg import splu
from skfem import Basis, ElementTetP1, MeshTet
from skfem.models.poisson import laplace

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh

APICAL_PATCH = 0.05
"""Longitudinal coordinate below which a node belongs to the apical patch."""

PARALLEL = 1e-6
"""Sine of the angle between two gradients below which they span no plane."""


def harmonic_extension(points: Floats, tets: Integers, fixed: Integers, values: Floats) -> Floats:
    """Solve div grad u = 0 for u (n, ...) with u = values (f, ...) on the nodes `fixed` (f,), no flux elsewhere."""
    stiffness = laplace.assemble(_basis(points, tets)).tocsr()
    free = np.setdiff1d(np.arange(len(points)), fixed)
    field = np.zeros((len(points), *values.shape[1:]))
    field[fixed] = values
    load = -stiffness[free][:, fixed] @ values.reshape(len(fixed), -1)
    field[free] = splu(stiffness[free][:, free].tocsc()).solve(load).reshape(len(free), *values.shape[1:])
    return field


def harmonic_between(points: Floats, tets: Integers, one: Integers, zero: Integers) -> Floats:
    """Return the harmonic field (n,) that is 1 on the nodes `one` and 0 on the nodes `zero`; on shared ones, 1."""
    fixed = np.union1d(one, zero)
    return harmonic_extension(points, tets, fixed, np.isin(fixed, one).astype(float))


def element_gradients(points: Floats, tets: Integers, field: Floats) -> Floats:
    """Gradient (m,3) of a nodal field (n,) in each tetrahedron."""
    return np.asarray(_basis(points, tets).interpolate(field).grad)[:, :, 0].T


def _basis(points: Floats, tets: Integers) -> Basis:
    return Basis(
        MeshTet(np.ascontiguousarray(points.T), np.ascontiguousarray(tets.T)), ElementTetP1(), intorder=1
    )


def wall_gradient(mesh: VentricularMesh, field: Floats) -> Floats:
    """Gradient (m,3) of a field (n,) in each tetrahedron; the neighbours' mean replaces a vanishing one."""
    gradients = element_gradients(mesh.points, mesh.tets, field)
    volume = mesh.element_volumes()
    for _ in range(3):
        vanishing = np.linalg.norm(gradients, axis=1) < 1e-6 / np.cbrt(volume)
        gradients[vanishing] = _neighbour_mean(mesh, gradients)[vanishing]
    return gradients


def _neighbour_mean(mesh: VentricularMesh, gradients: Floats) -> Floats:
    """Direction (m,3), of any length, of the mean gradient over all tetrahedra that share a node with each."""
    volume, nodal = mesh.element_volumes(), np.zeros_like(mesh.points)
    np.add.at(nodal, mesh.tets, (gradients * volume[:, None])[:, None])
    mean: Floats = nodal[mesh.tets].mean(axis=1) / volume[:, None]
    return mean


def apicobasal_gradient(mesh: VentricularMesh) -> Floats:
    """Gradient (m,3) of the harmonic field from a patch at the apex to the base."""
    apex = np.flatnonzero(LeftVentricularAxes.from_mesh(mesh).longitudinal(mesh.points) < APICAL_PATCH)
    field = harmonic_between(mesh.points, mesh.tets, one=np.unique(mesh.surfaces["base"]), zero=apex)
    return wall_gradient(mesh, field)


def replace_parallel(mesh: VentricularMesh, along: Floats, across: Floats) -> Floats:
    """Return `along` (m,3), replaced by the neighbours' mean if it is parallel to `across` (m,3)."""
    sine = np.linalg.norm(np.cross(normalise_rows(along), normalise_rows(across)), axis=1)
    return np.where((sine < PARALLEL)[:, None], _neighbour_mean(mesh, along), along)


def normalise_rows(vectors: Floats) -> Floats:
    """Return vectors (m,3) of length one in the same directions."""
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), np.finfo(float).tiny)
