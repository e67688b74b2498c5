"""Where a point lies in the ventricles: the axes of the left ventricle and the longitudinal coordinate."""

from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.surface import triangle_normals
from heartfit.geometry.topology import rim_loops


@dataclass(frozen=True, eq=False)
class LeftVentricularAxes:
    """Origin at the epicardial apex, axis to the centre of the valve rings, septal towards the right ventricle.

    apex (3,) m; axis, septal, anterior (3,) orthonormal, anterior = axis x septal; length m from apex to ring centre.
    """

    apex: Floats
    axis: Floats
    septal: Floats
    anterior: Floats
    length: float

    @classmethod
    def of(cls, mesh: VentricularMesh) -> "LeftVentricularAxes":
        """The axes of a mesh, from the left rims, the epicardium and the septal part of the right endocardium."""
        ring = mesh.points[np.concatenate(rim_loops(mesh.surfaces["lv_endo"]))].mean(axis=0)
        outer = mesh.points[np.unique(mesh.surfaces["epi"])]
        apex = outer[np.linalg.norm(outer - ring, axis=1).argmax()]
        length = float(np.linalg.norm(ring - apex))
        axis = (ring - apex) / length
        centre = mesh.points[np.unique(mesh.surfaces["lv_endo"])].mean(axis=0)
        towards = mesh.points[np.unique(mesh.surfaces["rv_endo"])].mean(axis=0) - centre
        septal = towards - (towards @ axis) * axis
        septal /= np.linalg.norm(septal)
        return cls(apex, axis, septal, np.cross(axis, septal), length)

    def longitudinal(self, points: Floats) -> Floats:
        """0 at the apex, 1 at the height of the valve rings and above: zeta = (x - apex).axis / length."""
        return np.clip((points - self.apex) @ self.axis / self.length, 0.0, 1.0)

    def angle(self, points: Floats) -> Floats:
        """Angle in rad around the axis, 0 at the middle of the septum, positive towards anterior."""
        return np.arctan2((points - self.apex) @ self.anterior, (points - self.apex) @ self.septal)

    def away(self, points: Floats) -> Floats:
        """Vectors (n,3) in m from the axis to the points."""
        offset = points - self.apex
        return offset - (offset @ self.axis)[:, None] * self.axis


def septal_faces(mesh: VentricularMesh, axes: LeftVentricularAxes) -> Integers:
    """The triangles of the right endocardium on the septum: those that face away from the left ventricle's axis."""
    faces = mesh.surfaces["rv_endo"]
    outward = (triangle_normals(mesh.points, faces) * axes.away(mesh.points[faces].mean(axis=1))).sum(axis=1)
    return faces[outward > 0.0]
