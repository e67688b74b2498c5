"""Checks that images and end-diastolic mesh show the same heart, at the same place and in the same orientation.

The mesh tells which voxels are wall and which are blood; a threshold (Otsu, IEEE Trans Syst Man Cybern 1979) tells
which of them are dark and which are bright, as blood is in cine images. Voxels outside the heart do not count: in front
of black lung, wall would count as bright. The agreement is the mean of two Dice coefficients,
2 |A and B| / (|A| + |B|), of blood with bright and of wall with dark: 1 if all voxels agree, about 1/2 for images
independent of the mesh. The orientation of a heart that is its own mirror image cannot be checked.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import Protocol

import numpy as np
import SimpleITK as sitk
from numpy.typing import NDArray

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity, HasSurfaces
from heartfit.imaging.raster import paint_inside
from heartfit.imaging.sequence import PATIENT_DIRECTIONS, Grid, ImageSequence

COVERAGE_MARGIN = 2e-3
"""Distance [m] by which the mesh must stay within the images."""

MIN_DICE = 0.7
"""Smallest agreement of images and mesh of the same heart."""

MIN_DICE_GAIN = 0.08
"""Gain in agreement from which another orientation refuses the present one."""

OUTSIDE, WALL, BLOOD = 0.0, 1.0, 2.0
"""Labels of painted voxels."""


class BothVentricles(HasSurfaces, Protocol):
    """A mesh or a labelled surface of both ventricles."""

    @property
    def points(self) -> Floats: ...


def require_match(sequence: ImageSequence, wall: BothVentricles, margin: float = COVERAGE_MARGIN) -> None:
    """Raise InputError unless the first frame shows the heart of the end-diastolic mesh where the mesh is.

    The message names reversed axes of the voxels or negated coordinates of the mesh (as between the conventions of
    DICOM and NIfTI), with the Dice before and after; or the length in mm by which the images miss the mesh; or the best
    agreement. A negative margin lets the mesh reach out of the images, as over sparse slices.
    """
    image, grid, parts = sequence.voxels[0], sequence.grid, ClosedSurfaces.from_surfaces(wall)
    covered = _overhang(grid, wall.points, margin).max() <= 0.0
    actual = agreement(image, parts.paint(grid, wall.points)) if covered else 0.0
    mirrored = dict(_mirrored_agreements(image, grid, parts, wall.points))
    best = max(mirrored, key=lambda correction: mirrored[correction])
    if mirrored[best] > max(actual + MIN_DICE_GAIN, MIN_DICE):
        raise InputError(
            f"images and mesh: Dice {actual:.2f} as they are, {mirrored[best]:.2f} with {best}; "
            "correct the orientation of the images or the mesh"
        )
    require_covered(grid, wall.points, margin)
    if actual < MIN_DICE:
        raise InputError(
            f"images and mesh: Dice {actual:.2f} of bright voxels with cavities and dark ones with wall, mirrored "
            f"{mirrored[best]:.2f} at best; expected {MIN_DICE:g}: take the images of this mesh, end diastole first"
        )


def require_covered(grid: Grid, points: Floats, margin: float = COVERAGE_MARGIN) -> None:
    """Raise InputError unless all points (n, 3) [m] lie within the box of voxels, by the margin [m]."""
    overhang = _overhang(grid, points, margin)
    if overhang.max() > 0.0:
        side, axis = np.unravel_index(int(overhang.argmax()), overhang.shape)
        end = ("first", "last")[side]
        raise InputError(
            f"images: the mesh reaches {1e3 * (overhang.max() - margin):.1f} mm beyond the {end} voxels along "
            f"{'ijk'[axis]}, {_patient_direction(grid, int(axis), int(side))}; expected {1e3 * margin:g} mm within: "
            "take images that cover the heart"
        )


def agreement(image: Floats, painted: Floats) -> float:
    """Mean of the two Dice coefficients of an image (k, j, i) with a painted mesh; 0 without wall or blood."""
    wall, blood = painted == WALL, painted == BLOOD
    heart = wall | blood
    if not (wall.any() and blood.any()):
        return 0.0
    bright = image[heart] > _otsu_threshold(image[heart])
    return 0.5 * (_dice(blood[heart], bright) + _dice(wall[heart], ~bright))


@dataclass(frozen=True, eq=False)
class ClosedSurfaces:
    """Closed surfaces about the wall and about both cavities."""

    wall: Integers
    cavities: tuple[Cavity, ...]

    @classmethod
    def from_surfaces(cls, wall: HasSurfaces) -> "ClosedSurfaces":
        cavities = tuple(Cavity.from_endocardium(wall, name) for name in ("lv_endo", "rv_endo"))
        return cls(np.vstack(list(wall.surfaces.values())), cavities)

    def paint(self, grid: Grid, points: Floats) -> Floats:
        """Label each voxel (k, j, i) OUTSIDE, WALL or BLOOD, with the nodes at points (n, 3) [m]."""
        image, unmoved = np.full(grid.shape, OUTSIDE), np.zeros((grid.shape[0], 2))
        index = grid.index(points)
        paint_inside(image, index, self.wall, WALL, unmoved)
        for cavity in self.cavities:
            corners = cavity.corners(index)
            paint_inside(image, corners, cavity.triangles % len(corners), BLOOD, unmoved)
        return image


def _mirrored_agreements(
    image: Floats, grid: Grid, parts: ClosedSurfaces, points: Floats
) -> Iterator[tuple[str, float]]:
    """Yield each possible correction of a mirrored image or mesh, in words, and the agreement after it."""
    painted = parts.paint(grid, points)
    for axes in (axes for count in (1, 2, 3) for axes in combinations(range(3), count)):
        indices, coordinates = (" and ".join(names[axis] for axis in axes) for names in ("ijk", "xyz"))
        reverse = np.flip(image, tuple(2 - axis for axis in axes))
        yield f"voxels in reverse along {indices}", agreement(reverse, painted)
        negated = np.where(np.isin(np.arange(3), axes), -points, points)
        if _overhang(grid, negated, 0.0).max() <= 0.0:
            yield f"the mesh's {coordinates} negated", agreement(image, parts.paint(grid, negated))


def _overhang(grid: Grid, points: Floats, margin: float) -> Floats:
    """Length (2, 3) [m] by which points exceed the box less the margin, at the first and last voxel of each axis."""
    index = grid.index(points)
    first, last = -0.5 - index.min(axis=0), index.max(axis=0) - (np.array(grid.size) - 0.5)
    overhang: Floats = np.stack([first, last]) * grid.spacing + margin
    return overhang


def _patient_direction(grid: Grid, axis: int, side: int) -> str:
    direction = grid.direction[:, axis] * (1.0 if side else -1.0)
    nearest = int(np.abs(direction).argmax())
    return f"towards the {PATIENT_DIRECTIONS[nearest][int(direction[nearest] > 0.0)]}"


def _otsu_threshold(values: Floats) -> float:
    otsu = sitk.OtsuThresholdImageFilter()
    otsu.Execute(sitk.GetImageFromArray(values.astype(np.float32)[None]))
    return float(otsu.GetThreshold())


def _dice(a: NDArray[np.bool_], b: NDArray[np.bool_]) -> float:
    total = int(np.count_nonzero(a)) + int(np.count_nonzero(b))
    return 2.0 * int(np.count_nonzero(a & b)) / max(total, 1)
