"""Tetrahedra of regular shapes as meshes of a wall."""

import numpy as np

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh, element_volumes


def oriented(points: Floats, tets: Integers) -> Integers:
    """The tetrahedra with positive volumes."""
    mirrored = element_volumes(points, tets) < 0.0
    return np.where(mirrored[:, None], tets[:, [0, 2, 1, 3]], tets)


def named(points: Floats, tets: Integers, surfaces: dict[str, Integers], fibres: Floats) -> VentricularMesh:
    """The mesh, at once activated and without a longitudinal coordinate: nothing here asks for either."""
    return VentricularMesh(points, tets, surfaces, fibres, None, np.zeros(len(tets)), np.zeros(len(points)))
