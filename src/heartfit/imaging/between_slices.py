"""Brightness between distant parallel slices, by registration of each slice to the next.

An edge of the heart lies elsewhere in the next slice, one or two centimetres away, so that a mean of two slices
shows it twice. At the share f of the way from slice k to k + 1 the image is instead the mean of both, each moved by
its share of the displacement u that carries slice k to k + 1:

    I(p) = (1 - f) I_k(p - f u(p)) + f I_(k+1)(p + (1 - f) u(p)) .

Beyond the stack the image is that of the outermost slice.

References
----------
Penney GP et al. 2004, IEEE Trans Med Imaging 23:922.
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import Self

import numpy as np
from scipy.ndimage import map_coordinates

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.imaging.registration.slices import CINE_DEMONS, Demons, register


@dataclass(frozen=True, eq=False)
class BetweenSlices:
    """Displacement (k-1, j, i, 2) in pixels along i and j from each slice of a stack to the next."""

    displacement: Floats

    @classmethod
    def of(cls, stack: Floats, method: Demons = CINE_DEMONS) -> Self:
        """Register each slice of a stack (k, j, i) to the next; raises InputError for a single slice."""
        if len(stack) < 2:
            raise InputError("slices: one slice; expected two or more, between which the image is sought")
        pairs = pairwise(stack)
        return cls(np.array([register(lower, upper, method) for lower, upper in pairs]))

    def brightness(self, stack: Floats, index: Floats) -> Floats:
        """Brightness (...) of a stack (k, j, i) at fractional indices (..., 3) in the order i, j, k."""
        height = np.clip(index[..., 2], 0, len(stack) - 1)
        lower = np.minimum(height.astype(int), len(stack) - 2)
        result = np.empty(height.shape)
        for k, field in enumerate(self.displacement):
            here = lower == k
            places, share = index[here][:, :2], (height[here] - k)[:, None]
            step = np.stack([_sample(field[..., axis], places, 1) for axis in (0, 1)], axis=-1)
            below = _sample(stack[k], places - share * step, 3)
            above = _sample(stack[k + 1], places + (1.0 - share) * step, 3)
            result[here] = (1.0 - share[:, 0]) * below + share[:, 0] * above
        return result


def _sample(image: Floats, places: Floats, order: int) -> Floats:
    """Values (n,) of an image (j, i) at places (n, 2) in the order i, j, by splines of this order."""
    values: Floats = map_coordinates(image, places.T[::-1], order=order, mode="nearest", output=float)
    return values
