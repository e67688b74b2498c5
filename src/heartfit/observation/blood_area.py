"""Left ventricular volume from the brightness of blood in short-axis slices, without the smoothing of a fitted surface.

The share of blood in a voxel follows from its brightness I and the medians of blood and wall in the first frame,

    f = clip((I - I_wall) / (I_blood - I_wall), 0, 1),

and the blood area A_k of slice k is the sum of f inside the first outline of the left endocardium, widened by
OUTLINE_MARGIN. Slices that a valve ring passes, or that the apex leaves, are not read. The areas do not hold the
papillary muscles, and slices alone do not show the motion of the valve plane, so the volume is

    V(t) = a + b L(t) sum_k A_k(t)

with the length L from apex to valve rings of the measured surface, and a, b fitted to its volume: size and scale are
those of the surface, the course over the beat is that of the images. An error of L is an error of both volumes. Where
half of the frames judges, the other half fits a and b again: see :mod:`heartfit.observation.second_reading`.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import binary_dilation, binary_erosion

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.sections import cut_surface
from heartfit.geometry.surface import LabelledSurface
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.observation.curve import Curve
from heartfit.observation.outlines import slice_plane

Mask = NDArray[np.bool_]
OUTLINE_MARGIN = 2
"""Voxels by which the outline of the first frame is widened: less than half a wall."""
CORE_MARGIN = 3
"""Voxels between an outline and the blood whose median brightness is taken: papillary muscles touch the wall."""
FEWEST_SLICES = 2


def inside(grid: Grid, segments: Floats) -> Mask:
    """Voxels (j, i) of a slice whose centres lie inside closed contours of segments (s, 2, 3) [m] in its plane."""
    start, end = np.moveaxis(grid.index(segments)[..., :2], 1, 0)
    j, i = np.arange(grid.size[1])[:, None], np.arange(grid.size[0])[None, :]
    crossings = np.zeros((grid.size[1], grid.size[0]), dtype=np.int64)
    for (x0, y0), (x1, y1) in zip(start.tolist(), end.tolist(), strict=True):
        if y0 != y1:
            spans = (j >= min(y0, y1)) & (j < max(y0, y1))
            crossings += spans & (i < x0 + (j - y0) * (x1 - x0) / (y1 - y0))
    return crossings % 2 == 1


@dataclass(frozen=True, eq=False)
class MeasuredWall:
    """Surface of a measured wall: in the first frame, and positions (p, n, 3) [m] of its points in every frame."""

    surface: LabelledSurface
    positions: Floats

    @cached_property
    def rim(self) -> Integers:
        """Points (r,) of the left valve rings."""
        return Cavity.from_endocardium(self.surface, "lv_endo").rim

    def outline(self, name: str, grid: Grid, k: int, frame: int = 0) -> Floats:
        """Segments (s, 2, 3) [m] in which slice k cuts a surface in one frame."""
        return cut_surface(self.positions[frame], self.surface.surfaces[name], *slice_plane(grid, k))

    def readable_slices(self, grid: Grid) -> list[int]:
        """Slices that cut the left endocardium below its rings in every frame."""
        kept = []
        for k in range(grid.size[2]):
            origin, normal = slice_plane(grid, k)
            above = (self.positions[:, self.rim] - origin) @ normal > 0.0
            cut = [len(self.outline("lv_endo", grid, k, frame)) > 0 for frame in range(len(self.positions))]
            if (above.all() or not above.any()) and all(cut):
                kept.append(k)
        return kept

    def length(self, grid: Grid) -> Floats:
        """Length (p,) [m] from the apex of the left cavity to the mean of its valve rings, across the slices."""
        nodes, rim = np.unique(self.surface.surfaces["lv_endo"]), self.rim
        heights = self.positions @ grid.direction[:, 2]
        towards = np.sign(heights[0, rim].mean() - heights[0, nodes].mean())
        return towards * heights[:, rim].mean(axis=1) - (towards * heights[:, nodes]).min(axis=1)


def blood_area(images: ImageSequence, wall: MeasuredWall, k: int) -> Floats:
    """Blood area (p,) [m^2] of the left cavity in slice k; raises InputError where blood is not brighter than wall."""
    grid, frames = images.grid, images.voxels[:, k].astype(float)
    cavity = inside(grid, wall.outline("lv_endo", grid, k))
    muscle = inside(grid, wall.outline("epi", grid, k)) & ~binary_dilation(cavity)
    right = wall.outline("rv_endo", grid, k)
    if len(right):
        muscle &= ~binary_dilation(inside(grid, right))
    core = binary_erosion(cavity, iterations=CORE_MARGIN)
    if not (core.any() and muscle.any()):
        raise InputError(f"slice {k}: the left cavity or its wall holds no voxel; expected finer images")
    blood, tissue = float(np.median(frames[0][core])), float(np.median(frames[0][muscle]))
    if not blood > tissue:
        raise InputError(
            f"slice {k}: median brightness {blood:g} of blood, {tissue:g} of the wall; expected brighter blood, as "
            "in a balanced steady-state cine: leave the images out"
        )
    share = np.clip((frames - tissue) / (blood - tissue), 0.0, 1.0)
    region = binary_dilation(cavity, iterations=OUTLINE_MARGIN)
    area: Floats = share[:, region].sum(axis=1) * grid.spacing[0] * grid.spacing[1]
    return area


def read_blood_volume(images: ImageSequence, wall: MeasuredWall, volume: Curve) -> Curve:
    """Volume [m^3] from the blood areas of the readable slices, at the size and scale of the surface's ``volume``.

    Images, wall and volume have the same frames. Raises InputError for other numbers of frames and for fewer than
    FEWEST_SLICES readable slices.
    """
    frames = {len(images.voxels), len(wall.positions), volume.times.size}
    if len(frames) > 1:
        raise InputError(f"cine: {sorted(frames)} frames of images, surface and volume; expected one number")
    slices = wall.readable_slices(images.grid)
    if len(slices) < FEWEST_SLICES:
        raise InputError(
            f"cine: {len(slices)} slices cut the left ventricle below its valves in every frame; expected at least "
            f"{FEWEST_SLICES}: images of the measured heart in the same coordinates"
        )
    product = wall.length(images.grid) * sum(blood_area(images, wall, k) for k in slices)
    design = np.column_stack([np.ones_like(product), product])
    fitted = design @ np.linalg.lstsq(design, volume.values, rcond=None)[0]
    return Curve.of_volume(volume.times, fitted, volume.period)
