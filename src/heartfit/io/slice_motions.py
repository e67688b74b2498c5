"""Motions of slices in their planes (.npz); a file is read back exactly as it was written."""

from pathlib import Path

import numpy as np

from heartfit.imaging.registration.slices import SliceMotion
from heartfit.imaging.sequence import Grid
from heartfit.io.files import replacing
from heartfit.io.meshes import read_arrays


def write_slice_motion(path: Path, motion: SliceMotion) -> None:
    """Write the grid [m], the corner of the region and the displacement [pixels]."""
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
    """Read a motion of write_slice_motion; raises InputError for a missing file."""
    stored = read_arrays(path, "size", "spacing", "origin", "direction", "corner", "displacement")
    i, j, k = stored["size"].tolist()
    column, row = stored["corner"].tolist()
    grid = Grid((i, j, k), stored["spacing"], stored["origin"], stored["direction"])
    return SliceMotion(grid, (column, row), stored["displacement"].astype(float))
