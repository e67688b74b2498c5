"""Directions in the wall that are gradients of harmonic fields, where a coarse mesh has none, too.

The gradient vanishes within a tetrahedron whose four nodes lie on one level of its field. Where three lie on a level
of two fields, as at the rim of the apical patch, both gradients are parallel and span no plane. What rounding leaves
there is no direction: the neighbours' mean is taken.
"""

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.laplace import between, element_gradients
from heartfit.geometry.mesh import VentricularMesh

APICAL_PATCH = 0.05
PARALLEL = 1e-6
"""Sine of the angle between two gradients below which they span no plane."""


def gradient(mesh: VentricularMesh, field: Floats) -> Floats:
    """Of a field (n,), in each tetrahedron (m,3); where it vanishes, the direction of the neighbours' mean."""
    found = element_gradients(mesh.points, mesh.tets, field)
    volume = mesh.element_volumes()
    for _ in range(3):
        missing = np.linalg.norm(found, axis=1) < 1e-6 / np.cbrt(volume)
        found[missing] = _among_neighbours(mesh, found)[missing]
    return found


def _among_neighbours(mesh: VentricularMesh, found: Floats) -> Floats:
    """In the direction of the mean (m,3) of a gradient over all tetrahedra that share a node with each."""
    volume, nodal = mesh.element_volumes(), np.zeros_like(mesh.points)
    np.add.at(nodal, mesh.tets, (found * volume[:, None])[:, None])
    mean: Floats = nodal[mesh.tets].mean(axis=1) / volume[:, None]
    return mean


def apex_to_base(mesh: VentricularMesh) -> Floats:
    """Gradient (m,3) of the harmonic field from a patch at the apex to the base."""
    apex = np.flatnonzero(LeftVentricularAxes.of(mesh).longitudinal(mesh.points) < APICAL_PATCH)
    field = between(mesh.points, mesh.tets, one=np.unique(mesh.surfaces["base"]), zero=apex)
    return gradient(mesh, field)


def not_parallel(mesh: VentricularMesh, along: Floats, across: Floats) -> Floats:
    """The direction `along` (m,3), or that of the neighbours where it is parallel to `across` (m,3)."""
    sine = np.linalg.norm(np.cross(unit(along), unit(across)), axis=1)
    return np.where((sine < PARALLEL)[:, None], _among_neighbours(mesh, along), along)


def unit(vectors: Floats) -> Floats:
    """Vectors (m,3) of length one in the same directions."""
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), np.finfo(float).tiny)
