"""The wall between three smooth functions: both cavities and the outside.

All are in metres on a box of points, negative inside. The wall is where none of the cavities is and the outside is not:
max(outside, -left, -right) < 0. Where the right ventricle's wall is not segmented the outside is a stated distance from
the cavities; nowhere is the wall about them thinner.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_fill_holes, distance_transform_edt, gaussian_filter
from scipy.spatial import cKDTree

from heartfit.geometry.arrays import Floats
from heartfit.imaging.grid import Grid
from heartfit.segmentation.box import Box
from heartfit.segmentation.checks import require_one_piece, require_upright
from heartfit.segmentation.labels import Segmentation
from heartfit.segmentation.stack import Stack

COARSEST, POINTS_IN_WALL = 2e-3, 1.5
"""Largest spacing of points, m, and spacings that the thinnest wall is thick; with one, holes open in it."""


AROUND = 3.0
"""Spacings beyond the thinnest wall in which the distance from the cavities is taken exactly."""


@dataclass(frozen=True)
class Shaping:
    """How a surface is made of labelled voxels.

    right_wall: thickness of the right ventricle's free wall where it is not segmented, and least thickness of all wall
    about the cavities, m; above_base: how far above the middle of the last slice below the valves the base is cut, m,
    half a slice's step if None; smoothing: standard deviation of the Gaussian that takes the steps of the voxels away,
    m.
    """

    right_wall: float = 3e-3
    above_base: float | None = None
    smoothing: float = 1.5e-3

    @property
    def spacing(self) -> float:
        """Of the points between which the surface is found, m."""
        return min(COARSEST, self.right_wall / POINTS_IN_WALL)

    def base(self, stack: Stack, grid: Grid) -> float:
        """Height of the base above the first slice of a stack, m."""
        step = float(grid.spacing[2])
        above = 0.5 * step if self.above_base is None else self.above_base
        return (len(stack.heart) - 1) * step + above


@dataclass(frozen=True, eq=False)
class Levels:
    """The functions of left cavity, right cavity and outside (h,v,u) m at the points of a box."""

    box: Box
    left: Floats
    right: Floats
    outside: Floats

    @property
    def wall(self) -> Floats:
        """Negative in the wall."""
        return np.maximum.reduce([self.outside, -self.left, -self.right])


def levels_of(segmentation: Segmentation, shaping: Shaping) -> Levels:
    """The functions of a segmentation; raises InputError where its slices cannot be used."""
    stack, grid = Stack.of(segmentation), segmentation.grid
    require_one_piece(stack)
    require_upright(stack, segmentation)
    above = shaping.base(stack, grid) - (len(stack.heart) - 1) * float(grid.spacing[2])
    return levels_in(Box.around(stack, grid, shaping.spacing, shaping.right_wall, above), shaping)


def levels_in(box: Box, shaping: Shaping) -> Levels:
    """The functions of the stack of a box."""
    stack = box.stack
    whole = stack.heart if "rv_wall" in stack.parts else stack.left
    masks = stack.parts["lv_cavity"], stack.parts["rv_cavity"], whole
    left, right, drawn = (_smooth(box.level(mask), shaping) for mask in masks)
    outside = np.minimum(drawn, _beyond(np.minimum(left, right), shaping))
    return Levels(box, left, right, _without_pits(outside, shaping.spacing))


def _smooth(field: Floats, shaping: Shaping) -> Floats:
    smooth: Floats = gaussian_filter(field, shaping.smoothing / shaping.spacing, mode="nearest")
    return smooth


def _beyond(cavities: Floats, shaping: Shaping) -> Floats:
    """Distance from the cavities less the least thickness of the wall."""
    steps = np.where(cavities < 0.0, -1.0, distance_transform_edt(cavities >= 0.0))
    near = np.argwhere((steps > 0.0) & (steps < shaping.right_wall / shaping.spacing + AROUND))
    steps[tuple(near.T)] = cKDTree(_crossings(cavities)).query(near)[0]
    return _smooth(shaping.spacing * steps - shaping.right_wall, shaping)


def _without_pits(outside: Floats, spacing: float) -> Floats:
    """The outside (h,v,u) m, where what it encloses in a layer, as between aorta and right ventricle, is wall."""
    heart = outside < 0.0
    filled = np.array([binary_fill_holes(layer) for layer in heart])
    return np.where(filled & ~heart, -spacing, outside)


def _crossings(field: Floats) -> Floats:
    """Where a function (h,v,u) is zero between neighbouring points, as fractional indices (n,3)."""
    places = []
    for axis in range(3):
        here, there = np.delete(field, -1, axis), np.delete(field, 0, axis)
        between = np.argwhere((here < 0.0) != (there < 0.0))
        start, end = here[tuple(between.T)], there[tuple(between.T)]
        places.append(between + np.outer(start / (start - end), np.eye(3)[axis]))
    return np.concatenate(places)
