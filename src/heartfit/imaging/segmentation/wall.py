"""Wall of a segmented heart between three level sets: both cavities and the outside.

All level sets are in metres on a box of points, negative inside. The wall is what neither cavities nor outside hold,
max(outside, -left, -right) < 0. Where the wall of the right ventricle is not segmented the outside is a stated distance
from the cavities; nowhere is the wall about them thinner. The labelled voxels must be one heart in the usual
orientation in its patient.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import binary_fill_holes, distance_transform_edt, gaussian_filter, label
from scipy.spatial import cKDTree

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.imaging.segmentation.levels import Box
from heartfit.imaging.segmentation.stack import Segmentation, Stack
from heartfit.imaging.sequence import PATIENT_DIRECTIONS, Grid

TO_APEX, TO_RIGHT_VENTRICLE = np.array([0.45, -0.45, -0.77]), np.array([-0.85, -0.5, -0.2])
"""Usual directions of a heart in scanner axes (left, posterior, superior): those of the measured heart, rounded."""

MAX_ROTATION = np.deg2rad(65.0)
"""Largest rotation [rad] of a heart from the usual directions; one mirrored along any axes is rotated by 87 degrees or
more."""
MAX_SPACING, SPACINGS_IN_WALL = 2e-3, 1.5
"""Largest spacing of points [m], and thickness of the thinnest wall in spacings; with one spacing, holes open in it."""
EXACT_DISTANCE_BAND = 3.0
"""Spacings beyond the thinnest wall in which the distance from the cavities is computed exactly."""


def require_one_piece(stack: Stack) -> None:
    """Raise InputError, naming a voxel, if a part consists of pieces that do not touch, not even by a corner."""
    parts = {
        "lv_cavity": stack.parts["lv_cavity"],
        "rv_cavity": stack.parts["rv_cavity"],
        "heart": stack.heart,
    }
    for name, mask in parts.items():
        pieces, count = label(mask, structure=np.ones((3, 3, 3)))
        if count > 1:
            sizes = np.bincount(pieces.ravel())[1:]
            k, j, i = np.argwhere(pieces == 1 + sizes.argmin())[0].tolist()
            voxel = i, j, stack.number(k)
            raise InputError(
                f"segmentation: {name} has {count} pieces, the smallest of {sizes.min()} voxels at {voxel}; "
                "expected one: remove stray voxels or fill the gap"
            )


def require_upright(stack: Stack, segmentation: Segmentation) -> None:
    """Raise InputError for an impossible orientation of the heart: mirrored, or in coordinates of another format."""
    to_apex = -stack.step * segmentation.grid.direction[:, 2]
    to_right = _centroid(segmentation, "rv_cavity") - _centroid(segmentation, "lv_cavity")
    rotation = _frame(TO_APEX, TO_RIGHT_VENTRICLE).T @ _frame(to_apex, to_right)
    if np.arccos(np.clip((np.trace(rotation) - 1.0) / 2.0, -1.0, 1.0)) > MAX_ROTATION:
        apex, right, usual_apex, usual_right = map(
            _patient_directions, (to_apex, to_right, TO_APEX, TO_RIGHT_VENTRICLE)
        )
        raise InputError(
            f"segmentation: apex towards {apex}, right ventricle towards {right}; expected about {usual_apex}, and "
            f"{usual_right}; the image is mirrored, or left and right are swapped: correct its axes, or the labels"
        )


def _centroid(segmentation: Segmentation, name: str) -> Floats:
    k, j, i = np.argwhere(segmentation.parts[name]).mean(axis=0)
    return segmentation.grid.points(np.array([i, j, k]))


def _frame(to_apex: Floats, to_right: Floats) -> Floats:
    """Orthonormal columns (3, 3): towards the apex, towards the right ventricle, and perpendicular to both."""
    axis = to_apex / np.linalg.norm(to_apex)
    across = to_right - (to_right @ axis) * axis
    across = across / np.linalg.norm(across)
    return np.column_stack([axis, across, np.cross(axis, across)])


def _patient_directions(direction: Floats) -> str:
    """Name the directions of the patient in which a vector mostly points."""
    share = direction / np.abs(direction).max()
    order = np.argsort(-np.abs(share))
    return " and ".join(
        PATIENT_DIRECTIONS[axis][int(share[axis] > 0.0)] for axis in order if abs(share[axis]) > 0.4
    )


@dataclass(frozen=True)
class Shaping:
    """Settings of the surface of labelled voxels.

    right_wall: thickness of the free wall of the right ventricle where it is not segmented, and smallest thickness of
    all wall about the cavities [m]; above_base: height of the base above the middle of the last slice below the valves
    [m], half a slice step if None; smoothing: standard deviation of the Gaussian that removes the steps of the voxels
    [m].
    """

    right_wall: float = 3e-3
    above_base: float | None = None
    smoothing: float = 1.5e-3

    @property
    def spacing(self) -> float:
        """Spacing [m] of the points between which the surface is interpolated."""
        return min(MAX_SPACING, self.right_wall / SPACINGS_IN_WALL)

    def base(self, stack: Stack, grid: Grid) -> float:
        """Height [m] of the base above the first slice of a stack."""
        step = float(grid.spacing[2])
        above = 0.5 * step if self.above_base is None else self.above_base
        return (len(stack.heart) - 1) * step + above


@dataclass(frozen=True, eq=False)
class LevelSets:
    """Level sets (h, v, u) [m] of left cavity, right cavity and outside at the points of a box."""

    box: Box
    left: Floats
    right: Floats
    outside: Floats

    @property
    def wall(self) -> Floats:
        """Level set (h, v, u) [m] of the wall, negative inside."""
        return np.maximum.reduce([self.outside, -self.left, -self.right])


def segmentation_level_sets(segmentation: Segmentation, shaping: Shaping) -> LevelSets:
    """Compute the level sets of a segmentation; raises InputError where its slices cannot be used."""
    stack, grid = Stack.from_segmentation(segmentation), segmentation.grid
    require_one_piece(stack)
    require_upright(stack, segmentation)
    above = shaping.base(stack, grid) - (len(stack.heart) - 1) * float(grid.spacing[2])
    return box_level_sets(Box.around(stack, grid, shaping.spacing, shaping.right_wall, above), shaping)


def box_level_sets(box: Box, shaping: Shaping) -> LevelSets:
    """Compute the level sets of the stack of a box."""
    stack = box.stack
    heart = stack.heart if "rv_wall" in stack.parts else stack.left
    masks = stack.parts["lv_cavity"], stack.parts["rv_cavity"], heart
    left, right, labelled = (_smooth(box.level(mask), shaping) for mask in masks)
    outside = np.minimum(labelled, _wall_margin(np.minimum(left, right), shaping))
    return LevelSets(box, left, right, _fill_pits(outside, shaping.spacing))


def _smooth(field: Floats, shaping: Shaping) -> Floats:
    smooth: Floats = gaussian_filter(field, shaping.smoothing / shaping.spacing, mode="nearest")
    return smooth


def _wall_margin(cavities: Floats, shaping: Shaping) -> Floats:
    """Distance (h, v, u) [m] from the cavities minus the smallest thickness of the wall."""
    steps = np.where(cavities < 0.0, -1.0, distance_transform_edt(cavities >= 0.0))
    near = np.argwhere((steps > 0.0) & (steps < shaping.right_wall / shaping.spacing + EXACT_DISTANCE_BAND))
    steps[tuple(near.T)] = cKDTree(_crossings(cavities)).query(near)[0]
    return _smooth(shaping.spacing * steps - shaping.right_wall, shaping)


def _fill_pits(outside: Floats, spacing: float) -> Floats:
    """Return the outside (h, v, u) [m]; what it encloses in a layer, as next to the aorta, becomes wall."""
    heart = outside < 0.0
    filled = np.array([binary_fill_holes(layer) for layer in heart])
    return np.where(filled & ~heart, -spacing, outside)


def _crossings(field: Floats) -> Floats:
    """Fractional indices (n, 3) of the zeros of a function (h, v, u) between neighbouring points."""
    places = []
    for axis in range(3):
        here, there = np.delete(field, -1, axis), np.delete(field, 0, axis)
        edges = np.argwhere((here < 0.0) != (there < 0.0))
        start, end = here[tuple(edges.T)], there[tuple(edges.T)]
        places.append(edges + np.outer(start / (start - end), np.eye(3)[axis]))
    return np.concatenate(places)
