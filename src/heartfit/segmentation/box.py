"""The points between which a segmented surface is found, apart equally in all directions."""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import map_coordinates

from heartfit.geometry.arrays import Floats
from heartfit.imaging.grid import Grid
from heartfit.segmentation.labels import Mask
from heartfit.segmentation.levels import interpolated, slice_distances
from heartfit.segmentation.stack import Stack, areas, lowest

MARGIN = 3
"""Points of the box beyond the heart."""


@dataclass(frozen=True, eq=False)
class Box:
    """Points (h,v,u) in the axes of a stack of slices; the last h is the plane of the base.

    columns (u,) and rows (v,): indices i and j in the images; heights (h,): m above the first slice of the stack.
    """

    grid: Grid
    stack: Stack
    spacing: float
    columns: Floats
    rows: Floats
    heights: Floats

    @classmethod
    def around(cls, stack: Stack, grid: Grid, spacing: float, wall: float, above_base: float) -> "Box":
        """The box that holds the heart and this much wall about it, up to a height above the stack's last slice, m."""
        heart = stack.heart
        reach = (wall + MARGIN * spacing) / grid.spacing[:2]
        seen = np.argwhere(heart.any(axis=0))[:, ::-1]
        columns, rows = (
            np.arange(low, high + step, step)
            for low, high, step in zip(
                seen.min(axis=0) - reach, seen.max(axis=0) + reach, spacing / grid.spacing[:2], strict=True
            )
        )
        distance = float(grid.spacing[2])
        top, bottom = (len(heart) - 1) * distance + above_base, (lowest(heart) - 1) * distance - wall
        count = int(np.ceil((top - bottom) / spacing)) + MARGIN
        return cls(grid, stack, spacing, columns, rows, top - spacing * np.arange(count, dtype=float)[::-1])

    def level(self, mask: Mask) -> Floats:
        """The smooth function (h,v,u) m of a part (k,j,i) of the stack, negative inside."""
        part, distance = mask[lowest(mask) :], float(self.grid.spacing[2])
        places = np.stack(np.meshgrid(self.rows, self.columns, indexing="ij"))
        slices = [
            map_coordinates(slice_, places, order=1, mode="nearest")
            for slice_ in slice_distances(part, self.grid.spacing[1::-1])
        ]
        return interpolated(np.array(slices), areas(part), distance, self.heights - lowest(mask) * distance)

    def image_grid(self) -> Grid:
        """Where these points lie as voxels of an image."""
        corner, *ends = self.points(np.vstack([np.zeros(3), np.eye(3)]))
        axes = np.column_stack(ends) - corner[:, None]
        spacing = np.linalg.norm(axes, axis=0)
        size = len(self.columns), len(self.rows), len(self.heights)
        return Grid(size, spacing, corner, axes / spacing)

    def points(self, places: Floats) -> Floats:
        """Places (n,3) m in the scanner's coordinates of fractional indices (n,3) in the order u, v, h."""
        i, j, h = (
            np.interp(place, np.arange(len(axis)), axis)
            for place, axis in zip(places.T, (self.columns, self.rows, self.heights), strict=True)
        )
        return self.grid.points(np.column_stack([i, j, self.stack.number(h / self.grid.spacing[2])]))
