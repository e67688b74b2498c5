"""Which voxels are cavity and which are wall, as somebody segmented them."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from heartfit.errors import InputError
from heartfit.imaging.grid import Grid

Mask = NDArray[np.bool_]

NEEDED = ("lv_cavity", "lv_wall", "rv_cavity")
PARTS = (*NEEDED, "rv_wall")


@dataclass(frozen=True, eq=False)
class Segmentation:
    """The labelled voxels of one moment of the beat.

    grid: where the voxels lie, its third axis across the short-axis slices; parts: name in PARTS -> mask (k,j,i), of
    which rv_wall may be missing, as the right ventricle's wall often is. Papillary muscles count as the part that they
    are labelled as. Raises InputError for a part that is missing, empty or of another shape.
    """

    grid: Grid
    parts: Mapping[str, Mask]

    def __post_init__(self) -> None:
        for name in NEEDED:
            if name not in self.parts:
                raise InputError(f"segmentation: {name} is missing; expected {', '.join(NEEDED)}")
        for name, mask in self.parts.items():
            if mask.shape != self.grid.shape:
                raise InputError(
                    f"segmentation: {name} has voxels {mask.shape}, expected {self.grid.shape} (k, j, i)"
                )
            if not mask.any():
                raise InputError(
                    f"segmentation: no voxel is {name}; expected the label of that part: state it anew"
                )

    @property
    def heart(self) -> Mask:
        """All that is labelled."""
        whole: Mask = np.logical_or.reduce(list(self.parts.values()))
        return whole
