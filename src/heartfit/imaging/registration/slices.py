"""In-plane motion of short-axis slices by diffeomorphic demons, coarse to fine.

Each iteration moves every voxel along the gradient of brightness until fixed(x) = moving(x + u(x)), composes u with the
exponential of that update, so that it stays invertible, and smooths it (Vercauteren et al. 2009, NeuroImage 45:S61,
doi 10.1016/j.neuroimage.2008.10.040; the filter is SimpleITK's). Images have two or three dimensions.

Slices that lie further apart than the wall is thick cannot be registered in three dimensions. Within a slice the tissue
leaves the plane (the base moves about 10 mm along the axis), so the registration follows the outlines of the heart in
the plane, not its material points.
"""

from dataclasses import dataclass

import numpy as np
import SimpleITK as sitk
from scipy.ndimage import map_coordinates

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.imaging.registration import registration_order
from heartfit.imaging.sequence import Grid, ImageSequence

REGION_MARGIN = 0.02
"""Distance [m] by which the registered region exceeds the points."""
PLANE_TOLERANCE = 1e-3
"""Largest distance of a point from the plane of its slice, in slice distances."""


@dataclass(frozen=True)
class Demons:
    """Settings of the demons registration.

    smoothing: standard deviation of the Gaussian that smooths the displacement after every iteration, in voxels of the
    level; levels: (factor by which the images are shrunk, number of iterations), from coarse to fine; step: largest
    update, in voxels of the level.
    """

    smoothing: float
    levels: tuple[tuple[int, int], ...] = ((4, 40), (2, 40), (1, 30))
    step: float = 2.0


def register(fixed: Floats, moving: Floats, method: Demons, start: Floats | None = None) -> Floats:
    """Displacement u (*shape, d) in voxels, components in the order i, j(, k), with fixed(x) = moving(x + u(x)).

    u carries a position in the fixed image to its position in the moving image. fixed, moving: arrays (k,) j, i of one
    shape, any unit of brightness; start (*shape, d): initial displacement. The same input gives the same output to the
    bit.
    """
    target, source = (sitk.GetImageFromArray(image.astype(np.float32)) for image in (fixed, moving))
    initial = np.zeros((*fixed.shape, fixed.ndim)) if start is None else start
    field = sitk.GetImageFromArray(initial, isVector=True)
    for shrink, iterations in method.levels:
        coarse_fixed, coarse_moving = (
            sitk.BinShrink(image, [shrink] * fixed.ndim) for image in (target, source)
        )
        field = _demons_filter(method, iterations).Execute(
            coarse_fixed, coarse_moving, _resample_field(coarse_fixed, field)
        )
    displacement: Floats = sitk.GetArrayFromImage(_resample_field(target, field))
    return displacement


def _demons_filter(method: Demons, iterations: int) -> sitk.DiffeomorphicDemonsRegistrationFilter:
    demons = sitk.DiffeomorphicDemonsRegistrationFilter()
    demons.SetNumberOfThreads(1)  # jobs run in parallel, and the order of sums is reproducible
    demons.SetNumberOfIterations(iterations)
    demons.SetSmoothDisplacementField(True)
    demons.SetStandardDeviations(method.smoothing)
    demons.SetMaximumUpdateStepLength(method.step)
    return demons


def _resample_field(image: sitk.Image, field: sitk.Image) -> sitk.Image:
    """Resample the field at the voxels of the image; beyond its own voxels it is constant."""
    return sitk.Resample(field, image, sitk.Transform(), sitk.sitkLinear, 0.0, sitk.sitkVectorFloat64, True)


def jacobian(displacement: Floats) -> Floats:
    """det(1 + du/dx) (*shape) of a displacement (*shape, d) in voxels, by central differences; <= 0 where it folds."""
    d = displacement.shape[-1]
    slopes = [np.gradient(displacement, axis=axis) for axis in reversed(range(d))]
    determinant: Floats = np.linalg.det(np.eye(d) + np.stack(slopes, axis=-1))
    return determinant


CINE_DEMONS = Demons(smoothing=3.0)
"""Settings chosen on the measured heart, see docs/measured_heart.md: with less smoothing the endocardium, next to
papillary muscles that join the wall in systole, moves too far inwards; with more smoothing not far enough."""


@dataclass(frozen=True, eq=False)
class SliceMotion:
    """Displacement of every slice in its plane, from the first frame on.

    grid: of the images; corner: first pixel (i, j) of the registered region; displacement (p, k, j, i, 2): from the
    first frame to frame p, in pixels along i and j, with integer k; displacement[0] = 0.
    """

    grid: Grid
    corner: tuple[int, int]
    displacement: Floats

    def carry(self, points: Floats) -> Floats:
        """Positions (p, n, 3) [m] in every frame of points (n, 3) [m] that lie in slices in the first frame.

        Raises InputError for a point between the slices or outside the region.
        """
        index = self.grid.index(points)
        place = index - [*self.corner, 0]
        last = np.array(self.displacement.shape[3:0:-1]) - 1
        outside = ((place < -PLANE_TOLERANCE) | (place > last + PLANE_TOLERANCE)).any(axis=1)
        between = np.abs(index[:, 2] - np.rint(index[:, 2])) > PLANE_TOLERANCE
        bad = np.flatnonzero(outside | between)
        if len(bad):
            raise InputError(
                f"slices: {len(bad)} of {len(points)} points are not in a registered slice, first voxel "
                f"{np.round(index[bad[0]], 2).tolist()}; expected an integer k, and i, j from {self.corner} on: "
                "cut the contours by the slices' planes and register a larger region"
            )
        steps = np.zeros((len(self.displacement), len(points), 3))
        for frame, field in enumerate(self.displacement):
            for axis in (0, 1):
                steps[frame, :, axis] = map_coordinates(
                    field[..., axis], place.T[::-1], order=1, mode="nearest"
                )
        return points + self.grid.vectors(steps)

    def carry_back(self, sequence: ImageSequence) -> Floats:
        """Brightness (p, k, j, i) of every frame at the positions of the first; beyond the region that of the frame."""
        (column, row), shape = self.corner, self.displacement.shape[2:4]
        rows, columns = slice(row, row + shape[0]), slice(column, column + shape[1])
        result, pixels = sequence.voxels.copy(), np.indices(shape)
        for frame, fields in enumerate(self.displacement):
            for k, field in enumerate(fields):
                places = pixels + np.moveaxis(field[..., ::-1], -1, 0)
                image = sequence.voxels[frame, k, rows, columns]
                result[frame, k, rows, columns] = map_coordinates(image, places, order=3, mode="nearest")
        return result

    def least_jacobian(self) -> Floats:
        """Smallest ratio (p, k) of an area to that in the first frame; not positive where a slice folds."""
        return np.array([[jacobian(field).min() for field in frame] for frame in self.displacement])


def register_slices(sequence: ImageSequence, about: Floats, method: Demons = CINE_DEMONS) -> SliceMotion:
    """Register every slice of every frame to the first frame, in a region about the points (n, 3) [m].

    The region extends REGION_MARGIN beyond the points. From the first frame on, forward and backward through the beat,
    each frame starts from the displacement of its neighbour.
    """
    rows, columns = region_about(sequence.grid, about)
    images = sequence.voxels[:, :, rows, columns]
    frames, slices = images.shape[:2]
    field = np.zeros((*images.shape, 2))
    for frame, neighbour in registration_order(frames):
        for k in range(slices):
            field[frame, k] = register(images[0, k], images[frame, k], method, field[neighbour, k])
    return SliceMotion(sequence.grid, (columns.start, rows.start), field)


def region_about(grid: Grid, about: Floats) -> tuple[slice, slice]:
    """Pixels j and i of the registered region about the points (n, 3) [m]."""
    index, margin = grid.index(about)[:, :2], REGION_MARGIN / grid.spacing[:2]
    low = np.maximum(np.floor(index.min(axis=0) - margin), 0).astype(int)
    high = np.minimum(np.ceil(index.max(axis=0) + margin) + 1, grid.size[:2]).astype(int)
    return slice(int(low[1]), int(high[1])), slice(int(low[0]), int(high[0]))


def require_unfolded(motion: SliceMotion) -> None:
    """Raise InputError that names the slices and frames in which the displacement folds."""
    least = motion.least_jacobian()
    folded = np.argwhere(least <= 0.0)
    if len(folded):
        places = ", ".join(f"slice {k} frame {frame}" for frame, k in folded.tolist())
        raise InputError(
            f"slices: the displacement folds in {places} (least Jacobian {least.min():.2g}); expected > 0: "
            "leave the frames out or smooth the displacement more"
        )
