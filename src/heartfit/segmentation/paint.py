"""The segmentation of a heart whose surface is known: what a perfect reader would draw into its images."""

import numpy as np
from scipy.ndimage import distance_transform_edt

from heartfit.geometry.arrays import Floats
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.surface import LabelledSurface
from heartfit.imaging.grid import Grid
from heartfit.imaging.raster import paint_inside
from heartfit.segmentation.labels import Mask, Segmentation

LEFT_REACH = 1.4
"""Distance from the left cavity, over the left wall's usual thickness, up to which wall is the left ventricle's."""


def segmented(surface: LabelledSurface, grid: Grid) -> Segmentation:
    """The parts whose voxels have their centres inside the closed surfaces; valves close the cavities flatly."""
    cavities = {}
    for part, name in (("lv_cavity", "lv_endo"), ("rv_cavity", "rv_endo")):
        cavity = Cavity.of(surface, name)
        corners = cavity.corners(surface.points)
        cavities[part] = _inside(grid, corners, cavity.triangles % len(corners))
    wall = _inside(grid, surface.points, surface.triangles) & ~cavities["lv_cavity"] & ~cavities["rv_cavity"]
    left = wall & _near_left(wall, grid, **cavities)
    return Segmentation(grid, {**cavities, "lv_wall": left, "rv_wall": wall & ~left})


def _inside(grid: Grid, points: Floats, triangles: np.ndarray) -> Mask:
    painted = np.zeros(grid.shape)
    paint_inside(painted, grid.index(points), triangles, 1.0, np.zeros((grid.shape[0], 2)))
    return painted > 0.0


def _near_left(wall: Mask, grid: Grid, lv_cavity: Mask, rv_cavity: Mask) -> Mask:
    """Voxels up to LEFT_REACH times the left wall's thickness, twice its median depth, from the left cavity."""
    to_left, to_right = (
        distance_transform_edt(~cavity, sampling=grid.spacing[::-1]) for cavity in (lv_cavity, rv_cavity)
    )
    thickness = 2.0 * float(np.median(to_left[wall & (to_left < to_right)]))
    near: Mask = to_left < LEFT_REACH * thickness
    return near
