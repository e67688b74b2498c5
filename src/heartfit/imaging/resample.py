"""Images on other voxels."""

from dataclasses import replace

import numpy as np
from scipy.ndimage import map_coordinates

from heartfit.geometry.arrays import Floats
from heartfit.imaging.grid import Grid
from heartfit.imaging.sequence import ImageSequence

SAME = 0.01


def isotropic(sequence: ImageSequence) -> ImageSequence:
    """The sequence on cubic voxels of its finest spacing, linear between the old ones; itself if they are cubic."""
    grid = sequence.grid
    unit = float(grid.spacing.min())
    if (np.abs(grid.spacing / unit - 1.0) < SAME).all():
        return sequence
    last = np.array(grid.size) - 1
    i, j, k = np.floor(last * grid.spacing / unit + 1e-9).astype(int) + 1
    cubic = Grid((int(i), int(j), int(k)), np.full(3, unit), grid.origin, grid.direction)
    steps = unit / grid.spacing[::-1]
    index = np.indices(cubic.shape) * steps[:, None, None, None]
    voxels = np.array([_linear(frame, index) for frame in sequence.voxels])
    return replace(sequence, grid=cubic, voxels=voxels)


def cropped(sequence: ImageSequence, points: Floats, margin: float) -> ImageSequence:
    """The voxels within ``margin``, m, of the box that holds the points (n,3) m; as far as there are any."""
    index, step = sequence.grid.index(points), margin / sequence.grid.spacing
    first = np.maximum(np.floor(index.min(axis=0) - step).astype(int), 0)
    last = np.minimum(np.ceil(index.max(axis=0) + step).astype(int), np.array(sequence.grid.size) - 1)
    i, j, k = (slice(a, b + 1) for a, b in zip(first.tolist(), last.tolist(), strict=True))
    size = last - first + 1
    origin = sequence.grid.points(first.astype(float))
    grid = replace(sequence.grid, size=(int(size[0]), int(size[1]), int(size[2])), origin=origin)
    return replace(sequence, grid=grid, voxels=sequence.voxels[:, k, j, i])


def _linear(frame: Floats, index: Floats) -> Floats:
    values: Floats = map_coordinates(frame, index, order=1, mode="nearest")
    return values
