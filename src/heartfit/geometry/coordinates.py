"""Coordinates of the left ventricle: its axes, the longitudinal coordinate, and the faces of the septum."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.surface import rim_loops, triangle_normals

APICAL_REACH = 0.9
"""Share of the largest distance from the valve rings beyond which endocardial nodes define the apex."""

SEPTAL_REACH = 1.4
"""Wall thickness over its median up to which the wall between the cavities is septum."""


@dataclass(frozen=True, eq=False)
class LeftVentricularAxes:
    """The long axis through the left cavity's apex and the centre of its valve rings.

    apex (3,) [m]: the point at which the axis leaves the wall; axis (from there to the rings), septal, anterior (3,):
    orthonormal with anterior = axis x septal; length [m] from apex to ring centre.
    """

    apex: Floats
    axis: Floats
    septal: Floats
    anterior: Floats
    length: float

    @classmethod
    def from_mesh(cls, mesh: VentricularMesh) -> "LeftVentricularAxes":
        """Return the axes of a mesh, from its endocardial surfaces and their rims."""
        ring = mesh.points[np.concatenate(rim_loops(mesh.surfaces["lv_endo"]))].mean(axis=0)
        left = mesh.points[np.unique(mesh.surfaces["lv_endo"])]
        reach = np.linalg.norm(left - ring, axis=1)
        axis = _normalise(ring - left[reach > APICAL_REACH * reach.max()].mean(axis=0))
        length = float(((ring - mesh.points) @ axis).max())
        towards = mesh.points[np.unique(mesh.surfaces["rv_endo"])].mean(axis=0) - left.mean(axis=0)
        septal = _normalise(towards - (towards @ axis) * axis)
        return cls(ring - length * axis, axis, septal, np.cross(axis, septal), length)

    def longitudinal(self, points: Floats) -> Floats:
        """Longitudinal coordinate (n,), zeta = (x - apex).axis / length, clipped to 0 (apex) .. 1 (valve rings)."""
        return np.clip((points - self.apex) @ self.axis / self.length, 0.0, 1.0)

    def angle(self, points: Floats) -> Floats:
        """Angle (n,) [rad] around the axis, 0 at the middle of the septum, positive towards anterior."""
        return np.arctan2((points - self.apex) @ self.anterior, (points - self.apex) @ self.septal)

    def away(self, points: Floats) -> Floats:
        """Radial vectors (n,3) [m] from the axis to the points."""
        offset = points - self.apex
        return offset - (offset @ self.axis)[:, None] * self.axis


def septal_faces(mesh: VentricularMesh, axes: LeftVentricularAxes) -> Integers:
    """Return the triangles of the right endocardium on the septum: near the left one, facing away from its axis."""
    faces = mesh.surfaces["rv_endo"]
    centres = mesh.points[faces].mean(axis=1)
    away = (triangle_normals(mesh.points, faces) * axes.away(centres)).sum(axis=1) > 0.0
    left = mesh.points[np.unique(mesh.surfaces["lv_endo"])]
    thickness = np.asarray(cKDTree(left).query(centres)[0])
    return faces[away & (thickness < SEPTAL_REACH * np.median(thickness[away]))]


def _normalise(vector: Floats) -> Floats:
    return vector / np.linalg.norm(vector)
