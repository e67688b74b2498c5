"""How good the tetrahedra are to compute on."""

import numpy as np

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.topology import FACES_OF_TET

PAIRS_OF_FACES = [(i, j) for i in range(4) for j in range(i)]


def smallest_dihedral_angles(points: Floats, tets: Integers) -> Floats:
    """Smallest dihedral angle (m,) in rad of each tetrahedron; 70.5 degrees at best, 0 for a sliver."""
    a, b, c = np.moveaxis(points[tets[:, FACES_OF_TET]], 2, 0)
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), np.finfo(float).tiny)
    cosines = [-(normals[:, i] * normals[:, j]).sum(axis=1) for i, j in PAIRS_OF_FACES]
    return np.arccos(np.clip(np.max(cosines, axis=0), -1.0, 1.0))
