"""Image sequence of one beat: voxel grid, frame times and checks of the data."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.geometry.mesh import require_phases

MAX_SHEAR = 1e-3
"""Largest deviation of the axes of an image from orthonormal ones."""
MAX_BRIGHTNESS = 1e12
"""Beyond the brightness of any scanner, 32 bits at most, and far below what single precision can square."""
PATIENT_DIRECTIONS = (("right", "left"), ("front", "back"), ("feet", "head"))
"""Directions of the patient along the axes x, y, z of the scanner, negative and positive."""


@dataclass(frozen=True, eq=False)
class Grid:
    """Box of voxels in scanner coordinates (left, posterior, superior), as in DICOM and ITK.

    The centre of voxel (i, j, k) is origin + direction (spacing * (i, j, k)). size (3,): voxels; spacing (3,): from
    centre to centre [m]; origin (3,): centre of voxel (0, 0, 0) [m]; direction (3, 3): its columns are the unit
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
        if not skew < MAX_SHEAR:
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
        """Positions (..., 3) [m] of (fractional) indices (..., 3) in the order i, j, k."""
        position: Floats = self.origin + index @ self._axes.T
        return position

    def index(self, points: Floats) -> Floats:
        """Fractional indices (..., 3) of positions (..., 3) [m]."""
        index: Floats = (points - self.origin) @ np.linalg.inv(self._axes).T
        return index

    def vectors(self, steps: Floats) -> Floats:
        """Vectors (..., 3) [m] of steps (..., 3) in voxels."""
        vectors: Floats = steps @ self._axes.T
        return vectors


@dataclass(frozen=True, eq=False)
class ImageSequence:
    """Images of one box of voxels at several times of one beat.

    grid: position of the voxels; voxels (p, k, j, i): float32, any unit of brightness; times (p,): after the trigger of
    the ECG, increasing, within one period [s]; period [s].
    Raises InputError for fewer than 8 frames, shapes that do not agree, voxels that are not finite or exceed
    MAX_BRIGHTNESS, an empty frame (one brightness everywhere) or times that do not increase or leave the period.
    """

    grid: Grid
    voxels: Floats
    times: Floats
    period: float

    def __post_init__(self) -> None:
        require_phases(len(self.times), "image sequence")
        expected = (len(self.times), *self.grid.shape)
        if self.voxels.shape != expected:
            raise InputError(
                f"image sequence: voxels {self.voxels.shape}, expected {expected} (time, k, j, i)"
            )
        for frame, voxels in enumerate(self.voxels):
            _require_sound(frame, voxels)
        self._require_times()

    def _require_times(self) -> None:
        steps = np.diff(self.times)
        if not (steps > 0.0).all():
            late = int(np.argmax(~(steps > 0.0))) + 1
            raise InputError(
                f"image sequence: frame {late} is at {self.times[late]:g} s, frame {late - 1} at "
                f"{self.times[late - 1]:g} s; expected increasing times: sort the frames by trigger time"
            )
        if self.times[0] < 0.0 or not self.times[-1] < self.period:
            raise InputError(
                f"image sequence: times run from {self.times[0]:g} to {self.times[-1]:g} s; "
                f"expected within [0, {self.period:g}) s: correct the period or the trigger times"
            )

    def starting_at(self, frame: int) -> "ImageSequence":
        """Return the same beat with this frame, end diastole, first and at time zero; InputError if there is none."""
        count = len(self.times)
        if not 0 <= frame < count:
            raise InputError(
                f"image sequence: end diastole is set to frame {frame}; expected 0 to {count - 1}: correct the frame"
            )
        times = np.mod(np.roll(self.times, -frame) - self.times[frame], self.period)
        return replace(self, voxels=np.roll(self.voxels, -frame, axis=0), times=times)


def _require_sound(frame: int, voxels: Floats) -> None:
    bad = np.argwhere(~(np.abs(voxels) < MAX_BRIGHTNESS))
    if len(bad):
        k, j, i = bad[0]
        raise InputError(
            f"image sequence: frame {frame} holds {len(bad)} voxels that are not finite or beyond {MAX_BRIGHTNESS:g}, "
            f"first ({i}, {j}, {k}) with {voxels[k, j, i]:g}; expected a scanner's brightness: export the frame again"
        )
    if not voxels.max() > voxels.min():
        raise InputError(
            f"image sequence: frame {frame} is {voxels.flat[0]:g} everywhere; "
            "expected an image: export the frame again"
        )
