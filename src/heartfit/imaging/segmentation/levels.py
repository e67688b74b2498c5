"""Level sets of the parts of a stack of slices: smooth functions of space, negative inside, zero on the surface.

In a slice the function is the signed distance from the outline; from slice to slice it is interpolated (shape-based
interpolation, Raya and Udupa 1990, doi 10.1109/42.52980). Below its last slice a part ends as a paraboloid, whose
area decreases linearly to zero:

    phi(s) = phi_0 + r (1 - sqrt(1 - s / h)),    h = step A_0 / (A_1 - A_0), at most a step

with s the distance below the last slice, r the largest radius inside its outline there, A_0 and A_1 the areas of the
last slice and the one above.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.ndimage import distance_transform_edt, map_coordinates

from heartfit.core.arrays import Floats
from heartfit.imaging.segmentation.stack import Mask, Stack, areas, lowest
from heartfit.imaging.sequence import Grid

MIN_TIP_LENGTH = 0.25
"""Smallest length of a tip, in steps; a shorter one is noise of the areas."""
MARGIN_POINTS = 3
"""Points of the box beyond the heart and its wall."""


def slice_distances(mask: Mask, pixel: Floats) -> Floats:
    """Signed distance (k, j, i) [m] from the outline in each slice, negative inside; pixel (2,) [m] along j and i."""
    return np.array([_signed_distance(slice_, pixel) for slice_ in mask])


def _signed_distance(slice_: Mask, pixel: Floats) -> Floats:
    """Signed distance from the outline, which runs midway between the centres of two pixels that differ."""
    half = 0.5 * float(pixel.mean())
    outside = distance_transform_edt(~slice_, sampling=pixel)
    inside = distance_transform_edt(slice_, sampling=pixel)
    signed: Floats = np.where(slice_, half - inside, outside - half)
    return signed


def tip_length(areas: Floats, step: float) -> float:
    """Length [m] of a part below its last slice; areas (2,) of the last slice and the one above."""
    last, above = areas
    share = last / (above - last) if above > last else 1.0
    return step * float(np.clip(share, MIN_TIP_LENGTH, 1.0))


def interpolate_slices(distances: Floats, areas: Floats, step: float, heights: Floats) -> Floats:
    """Level set (h, j, i) [m] at heights (h,) [m] above the first of the slices, all of which show the part.

    distances (k, j, i) [m] of slices ``step`` [m] apart; above the last slice the part continues unchanged.
    """
    places = step * np.arange(len(distances))
    central = PchipInterpolator(places, distances, axis=0)(np.clip(heights, 0.0, places[-1]))
    below = np.maximum(-heights, 0.0)[:, None, None]
    length, radius = tip_length(areas[:2], step), -float(distances[0].min())
    shrunk = radius * (1.0 - np.sqrt(np.clip(1.0 - below / length, 0.0, None)))
    levels: Floats = central + shrunk + np.maximum(below - length, 0.0)
    return levels


@dataclass(frozen=True, eq=False)
class Box:
    """Box of points (h, v, u) in the axes of a stack of slices; the last h is the plane of the base.

    columns (u,) and rows (v,): indices i and j in the images; heights (h,): above the first slice of the stack [m].
    """

    grid: Grid
    stack: Stack
    spacing: float
    columns: Floats
    rows: Floats
    heights: Floats

    @classmethod
    def around(cls, stack: Stack, grid: Grid, spacing: float, wall: float, above_base: float) -> "Box":
        """Return the box about heart and wall, up to ``above_base`` over the last slice; spacing and thickness [m]."""
        heart = stack.heart
        reach = (wall + MARGIN_POINTS * spacing) / grid.spacing[:2]
        pixels = np.argwhere(heart.any(axis=0))[:, ::-1]
        columns, rows = (
            np.arange(low, high + step, step)
            for low, high, step in zip(
                pixels.min(axis=0) - reach,
                pixels.max(axis=0) + reach,
                spacing / grid.spacing[:2],
                strict=True,
            )
        )
        distance = float(grid.spacing[2])
        top, bottom = (len(heart) - 1) * distance + above_base, (lowest(heart) - 1) * distance - wall
        count = int(np.ceil((top - bottom) / spacing)) + MARGIN_POINTS
        return cls(grid, stack, spacing, columns, rows, top - spacing * np.arange(count, dtype=float)[::-1])

    def level(self, mask: Mask) -> Floats:
        """Level set (h, v, u) [m] of a part (k, j, i) of the stack, negative inside."""
        part, distance = mask[lowest(mask) :], float(self.grid.spacing[2])
        places = np.stack(np.meshgrid(self.rows, self.columns, indexing="ij"))
        slices = [
            map_coordinates(slice_, places, order=1, mode="nearest")
            for slice_ in slice_distances(part, self.grid.spacing[1::-1])
        ]
        return interpolate_slices(
            np.array(slices), areas(part), distance, self.heights - lowest(mask) * distance
        )

    def image_grid(self) -> Grid:
        """Grid of an image whose voxels are the points of the box."""
        corner, *ends = self.points(np.vstack([np.zeros(3), np.eye(3)]))
        axes = np.column_stack(ends) - corner[:, None]
        spacing = np.linalg.norm(axes, axis=0)
        size = len(self.columns), len(self.rows), len(self.heights)
        return Grid(size, spacing, corner, axes / spacing)

    def points(self, places: Floats) -> Floats:
        """Positions (n, 3) [m] in scanner coordinates of fractional indices (n, 3) in the order u, v, h."""
        i, j, h = (
            np.interp(place, np.arange(len(axis)), axis)
            for place, axis in zip(places.T, (self.columns, self.rows, self.heights), strict=True)
        )
        return self.grid.points(np.column_stack([i, j, self.stack.number(h / self.grid.spacing[2])]))
