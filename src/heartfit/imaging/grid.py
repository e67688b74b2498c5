"""Where the voxels of an image lie."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats

LARGEST_SHEAR = 1e-3


@dataclass(frozen=True, eq=False)
class Grid:
    """A box of voxels in the scanner's coordinates (left, posterior, superior), as DICOM and ITK have it.

    The centre of voxel (i, j, k) is origin + direction (spacing * (i, j, k)). size (3,) voxels; spacing (3,) m,
    from centre to centre; origin (3,) m, the centre of voxel (0, 0, 0); direction (3,3), whose columns are the unit
    vectors of the axes i, j, k. Raises InputError for a size or spacing that is not positive and for axes that are
    not orthonormal.
    """

    size: tuple[int, int, int]
    spacing: Floats
    origin: Floats
    direction: Floats

    def __post_init__(self) -> None:
        if min(self.size) < 1:
            raise InputError(f"image: size {self.size}; expected at least one voxel along each axis")
        if not (np.isfinite(self.spacing).all() and (self.spacing > 0.0).all()):
            raise InputError(
                f"image: spacing {self.spacing} m; expected positive numbers; correct the header"
            )
        skew = np.abs(self.direction.T @ self.direction - np.eye(3)).max()
        if not skew < LARGEST_SHEAR:
            raise InputError(
                f"image: axes {self.direction.tolist()} are not orthonormal; "
                "expected directions of length one at right angles; correct the header"
            )

    @property
    def shape(self) -> tuple[int, int, int]:
        """Shape (k, j, i) of the array of voxels."""
        return self.size[::-1]

    @cached_property
    def _axes(self) -> Floats:
        axes: Floats = self.direction * self.spacing
        return axes

    def points(self, index: Floats) -> Floats:
        """Places (..., 3) in m of (fractional) indices (..., 3) in the order i, j, k."""
        place: Floats = self.origin + index @ self._axes.T
        return place

    def index(self, points: Floats) -> Floats:
        """Fractional indices (..., 3) of places (..., 3) in m."""
        found: Floats = (points - self.origin) @ np.linalg.inv(self._axes).T
        return found

    def vectors(self, steps: Floats) -> Floats:
        """Vectors (..., 3) in m of steps (..., 3) in voxels."""
        vectors: Floats = steps @ self._axes.T
        return vectors
