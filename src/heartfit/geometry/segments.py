"""The 17 segments of the left ventricle of the American Heart Association (Cerqueira et al. 2002)."""

import numpy as np
from numpy.typing import NDArray

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.coordinates import LeftVentricularAxes, septal_faces
from heartfit.geometry.harmonic import harmonic_between
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.territory import APEX, APICAL, BASAL, RIGHT_VENTRICLE


def aha_segments(mesh: VentricularMesh) -> Integers:
    """Return the segment (m,) of each tet: 1-6 basal, 7-12 mid, 13-16 apical, 17 apex, 0 right free wall.

    The three levels are thirds of the left cavity's length; the apex lies beyond the cavity's end.
    """
    axes = LeftVentricularAxes.from_mesh(mesh)
    centres = mesh.points[mesh.tets].mean(axis=1)
    height = (centres - axes.apex) @ axes.axis / axes.length
    end = ((mesh.points[np.unique(mesh.surfaces["lv_endo"])] - axes.apex) @ axes.axis).min() / axes.length
    level = np.clip(np.floor(3.0 * (height - end) / (1.0 - end)), -1, 2)
    segments = _segments_of_level(level, axes.angle(centres))
    return np.where(belongs_to_left(mesh, axes), segments, RIGHT_VENTRICLE)


def _segments_of_level(level: Floats, angle: Floats) -> Integers:
    """Return segments (m,) at levels (m,), 2 basal, 1 mid, 0 apical, -1 apex, and angles (m,) [rad]."""
    turn = np.mod(angle / (2.0 * np.pi), 1.0)
    basal = BASAL[np.minimum((6 * turn).astype(np.int64), 5)]
    apical = APICAL[np.mod(4 * turn + 0.5, 4.0).astype(np.int64) % 4]
    return np.select([level == 2, level == 1, level == 0], [basal, basal + 6, apical], APEX).astype(np.int64)


def belongs_to_left(mesh: VentricularMesh, axes: LeftVentricularAxes) -> NDArray[np.bool_]:
    """Mark the tets (m,) of left ventricle and septum, in which a harmonic field is above 1/2.

    The field is 1 on the left endocardium and on the septum's right side, 0 on the rest of the right endocardium.
    """
    septum = np.unique(septal_faces(mesh, axes))
    free = np.setdiff1d(np.unique(mesh.surfaces["rv_endo"]), septum)
    left = np.union1d(np.unique(mesh.surfaces["lv_endo"]), septum)
    return harmonic_between(mesh.points, mesh.tets, one=left, zero=free)[mesh.tets].mean(axis=1) > 0.5
