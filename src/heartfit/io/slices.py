"""The motion of short-axis slices as .npz; what is written is read back to single precision, far below a voxel."""

from pathlib import Path

import numpy as np

from heartfit.imaging.grid import Grid
from heartfit.io.arrays import read_arrays
from heartfit.io.atomic import replacing
from heartfit.registration.slices import SliceMotion


def write_slice_motion(path: Path, motion: SliceMotion) -> None:
    """Writes the grid in m, the corner of the region and the displacement in pixels."""
    grid = motion.grid
    with replacing(path) as draft:
        np.savez_compressed(
            draft,
            size=grid.size,
            spacing=grid.spacing,
            origin=grid.origin,
            direction=grid.direction,
            corner=motion.corner,
            displacement=motion.displacement.astype(np.float32),
        )


def read_slice_motion(path: Path) -> SliceMotion:
    """Reads what write_slice_motion wrote; raises InputError for a missing file."""
    stored = read_arrays(path, "size", "spacing", "origin", "direction", "corner", "displacement")
    i, j, k = stored["size"].tolist()
    column, row = stored["corner"].tolist()
    grid = Grid((i, j, k), stored["spacing"], stored["origin"], stored["direction"])
    return SliceMotion(grid, (column, row), stored["displacement"].astype(float))
