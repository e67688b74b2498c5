"""Rounding errors on purpose: what a job reads, moved in its last digits, as another processor would move it.

A study with ``jitter: k`` is member k of an ensemble that measures the numerical error of every number. The noise of a
member depends on the values alone, so that every job reads the same.
"""

import os
from zlib import crc32

import numpy as np

from heartfit.core.arrays import Floats

MEMBER = "HEARTFIT_JITTER"
"""Environment variable with the number of the member, which the workflow sets; none and 0 move nothing."""
RELATIVE = 1e-12
"""Largest relative move of a position; that of a voxel is one unit in the last place of its 32 bits."""


def moved_positions(positions: Floats) -> Floats:
    """Return positions, each coordinate moved by at most 1e-12 of itself."""
    rng = _generator(positions)
    return positions if rng is None else positions * (1.0 + rng.uniform(-RELATIVE, RELATIVE, positions.shape))


def moved_voxels(voxels: Floats) -> Floats:
    """Return voxels of 32 bits, each moved up or down to the next number; zeros stay."""
    rng = _generator(voxels)
    if rng is None:
        return voxels
    towards = np.where(rng.random(voxels.shape) < 0.5, -np.inf, np.inf).astype(voxels.dtype)
    return np.where(voxels == 0.0, voxels, np.nextafter(voxels, towards))


def _generator(values: Floats) -> np.random.Generator | None:
    member = int(os.environ.get(MEMBER, "0"))
    return np.random.default_rng([member, crc32(values.tobytes())]) if member else None
