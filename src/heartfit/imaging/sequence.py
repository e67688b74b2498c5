"""A sequence of images over one beat."""

from dataclasses import dataclass, replace

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.geometry.motion import require_phases
from heartfit.imaging.grid import Grid

BRIGHTEST = 1e12
"""Beyond what scanners write, 32 bits at most, and far below what single precision can square."""


@dataclass(frozen=True, eq=False)
class ImageSequence:
    """The same box of voxels at several times of one beat.

    grid: where the voxels lie; voxels (p, k, j, i) float32, any unit of brightness; times (p,) s after the trigger of
    the ECG, increasing, within one period; period s.
    Raises InputError for fewer than 8 frames, shapes that do not agree, voxels that are not finite or brighter than any
    scanner's, a frame that is empty (one brightness everywhere) or times that do not increase or leave the period.
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
        """The same beat with this frame, end diastole, first and at time zero; raises InputError if there is none."""
        count = len(self.times)
        if not 0 <= frame < count:
            raise InputError(
                f"image sequence: end diastole is said to be frame {frame}; expected 0 to {count - 1}: correct it"
            )
        times = np.mod(np.roll(self.times, -frame) - self.times[frame], self.period)
        return replace(self, voxels=np.roll(self.voxels, -frame, axis=0), times=times)


def _require_sound(frame: int, voxels: Floats) -> None:
    bad = np.argwhere(~(np.abs(voxels) < BRIGHTEST))
    if len(bad):
        k, j, i = bad[0]
        raise InputError(
            f"image sequence: frame {frame} holds {len(bad)} voxels that are not finite or beyond {BRIGHTEST:g}, first "
            f"({i}, {j}, {k}) with {voxels[k, j, i]:g}; expected a scanner's brightness: export the frame again"
        )
    if not voxels.max() > voxels.min():
        raise InputError(f"image sequence: frame {frame} is {voxels.flat[0]:g} everywhere; expected an image")
