"""One level of a pyramid of images."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.ndimage import gaussian_filter

from heartfit.geometry.arrays import Floats


@dataclass(frozen=True, eq=False)
class Level:
    """Voxels that are means of blocks of ``shrink`` voxels a side, and their places along each axis, in fine voxels."""

    shrink: int
    places: tuple[Floats, ...]

    @classmethod
    def of(cls, shape: Sequence[int], shrink: int) -> "Level":
        """The level of images of this shape; what is left of a block at the far sides is left out."""
        return cls(shrink, tuple(shrink * np.arange(float(n // shrink)) + 0.5 * (shrink - 1) for n in shape))

    def reduced(self, image: Floats) -> Floats:
        """The image smoothed by half a block and averaged over blocks, in single precision."""
        return self._blocks(gaussian_filter(image.astype(np.float32), 0.5 * self.shrink, mode="nearest"))

    def total(self, weight: Floats) -> Floats:
        """The sum of a weight over each block."""
        total: Floats = self._blocks(weight.astype(np.float32)) * self.shrink**weight.ndim
        return total

    def index(self, places: Floats) -> Floats:
        """Indices of this level of places in fine voxels."""
        index: Floats = (places - 0.5 * (self.shrink - 1)) / self.shrink
        return index

    def _blocks(self, image: Floats) -> Floats:
        for axis, places in enumerate(self.places):
            kept = np.take(image, np.arange(len(places) * self.shrink), axis)
            split = (*kept.shape[:axis], len(places), self.shrink, *kept.shape[axis + 1 :])
            image = kept.reshape(split).mean(axis=axis + 1)
        return image
