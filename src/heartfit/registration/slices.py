"""The motion that short-axis images show in their own planes, slice by slice.

Slices that lie further apart than the wall is thick cannot be registered in three dimensions. Within a slice the tissue
leaves the plane (the base moves about 10 mm along the axis), so what is found is where the outlines of the heart go in
the plane, not where its material points go.
"""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import map_coordinates

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.imaging.grid import Grid
from heartfit.imaging.sequence import ImageSequence
from heartfit.registration.demons import Demons, jacobian, register
from heartfit.registration.order import in_turn

CINE = Demons(smoothing=3.0)
"""Chosen on the measured heart, see docs/measured_heart.md: with less smoothing the endocardium, beside papillary
muscles that join the wall in systole, goes too far inwards; with more it does not arrive."""

MARGIN = 0.02
OFF_PLANE = 1e-3
"""How many slice distances a point may lie off its plane."""


@dataclass(frozen=True, eq=False)
class SliceMotion:
    """Where the first frame of every slice goes in the plane of the slice.

    grid: of the images; corner: first pixel (i, j) of the region that was registered; displacement (p,k,j,i,2) from the
    first frame to frame p, in pixels along i and j, slice k whole; displacement[0] = 0.
    """

    grid: Grid
    corner: tuple[int, int]
    displacement: Floats

    def carry(self, points: Floats) -> Floats:
        """Where points (n,3) m of the slices' planes in the first frame are in every frame (p,n,3) m.

        Raises InputError for a point between the slices or outside the region.
        """
        index = self.grid.index(points)
        place = index - [*self.corner, 0]
        last = np.array(self.displacement.shape[3:0:-1]) - 1
        outside = ((place < -OFF_PLANE) | (place > last + OFF_PLANE)).any(axis=1)
        between = np.abs(index[:, 2] - np.rint(index[:, 2])) > OFF_PLANE
        bad = np.flatnonzero(outside | between)
        if len(bad):
            raise InputError(
                f"slices: {len(bad)} of {len(points)} points are not in a registered slice, first voxel "
                f"{np.round(index[bad[0]], 2).tolist()}; expected a whole k and i, j from {self.corner} on: "
                "cut the contours by the slices' planes and register a larger region"
            )
        steps = np.zeros((len(self.displacement), len(points), 3))
        for frame, field in enumerate(self.displacement):
            for axis in (0, 1):
                steps[frame, :, axis] = map_coordinates(
                    field[..., axis], place.T[::-1], order=1, mode="nearest"
                )
        return points + self.grid.vectors(steps)

    def least_jacobian(self) -> Floats:
        """Smallest ratio (p,k) of an area to what it was in the first frame; not positive where a slice folds."""
        return np.array([[jacobian(field).min() for field in frame] for frame in self.displacement])


def register_slices(sequence: ImageSequence, about: Floats, method: Demons = CINE) -> SliceMotion:
    """Registers every slice of every frame to the first frame, in a region about the points (n,3) m.

    The region reaches MARGIN beyond the points. From the first frame on, forward and backward through the beat, each
    frame starts from what its neighbour has found.
    """
    rows, columns = _region(sequence.grid, about)
    images = sequence.voxels[:, :, rows, columns]
    frames, slices = images.shape[:2]
    field = np.zeros((*images.shape, 2))
    for frame, neighbour in in_turn(frames):
        for k in range(slices):
            field[frame, k] = register(images[0, k], images[frame, k], method, field[neighbour, k])
    return SliceMotion(sequence.grid, (columns.start, rows.start), field)


def _region(grid: Grid, about: Floats) -> tuple[slice, slice]:
    """The pixels j and i of the box about the points."""
    index, margin = grid.index(about)[:, :2], MARGIN / grid.spacing[:2]
    low = np.maximum(np.floor(index.min(axis=0) - margin), 0).astype(int)
    high = np.minimum(np.ceil(index.max(axis=0) + margin) + 1, grid.size[:2]).astype(int)
    return slice(int(low[1]), int(high[1])), slice(int(low[0]), int(high[0]))


def require_unfolded(motion: SliceMotion) -> None:
    """Raises InputError that names the slices and frames in which the displacement folds."""
    least = motion.least_jacobian()
    folded = np.argwhere(least <= 0.0)
    if len(folded):
        named = ", ".join(f"slice {k} frame {frame}" for frame, k in folded.tolist())
        raise InputError(
            f"slices: the displacement folds in {named} (least Jacobian {least.min():.2g}); expected > 0: "
            "leave the frames out or smooth the displacement more"
        )
