"""How good the tetrahedra are to compute on."""

import numpy as np

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.surface import LabelledSurface
from heartfit.geometry.topology import FACES_OF_TET, euler_characteristic, rim_loops

SMALLEST_ANGLE = np.deg2rad(8.0)
LARGEST_VOLUME_ERROR = 0.02
PAIRS_OF_FACES = [(i, j) for i in range(4) for j in range(i)]


def smallest_dihedral_angles(points: Floats, tets: Integers) -> Floats:
    """Smallest dihedral angle (m,) in rad of each tetrahedron; 70.5 degrees at best, 0 for a sliver."""
    a, b, c = np.moveaxis(points[tets[:, FACES_OF_TET]], 2, 0)
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=2, keepdims=True), np.finfo(float).tiny)
    cosines = [-(normals[:, i] * normals[:, j]).sum(axis=1) for i, j in PAIRS_OF_FACES]
    return np.arccos(np.clip(np.max(cosines, axis=0), -1.0, 1.0))


def defect_of(mesh: VentricularMesh, surface: LabelledSurface, smallest_angle: float = SMALLEST_ANGLE) -> str:
    """What is wrong with a mesh that shall fill this surface, or nothing; smallest_angle: dihedral, rad."""
    error = mesh.wall_volume() / surface.volume() - 1.0
    if abs(error) > LARGEST_VOLUME_ERROR:
        return f"wall volume off by {100 * error:+.1f} %"
    angle = smallest_dihedral_angles(mesh.points, mesh.tets).min()
    if angle < smallest_angle:
        return f"smallest dihedral angle {np.rad2deg(angle):.1f} degrees"
    boundary = np.vstack(list(mesh.surfaces.values()))
    found, wished = euler_characteristic(boundary), euler_characteristic(surface.triangles)
    if found != wished:
        return f"hole in a wall thinner than the tolerance (Euler characteristic {found} instead of {wished})"
    for name in ("lv_endo", "rv_endo"):
        loops, expected = len(rim_loops(mesh.surfaces[name])), len(rim_loops(surface.surfaces[name]))
        if loops != expected:
            return f"{name} has {loops} openings instead of {expected}"
    return ""
