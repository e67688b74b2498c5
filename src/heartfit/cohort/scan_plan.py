"""Where a scanner's voxels lie about a heart, and the finer ones whose mean each of them shows (partial volume)."""

from functools import reduce
from itertools import product

import numpy as np

from heartfit.cohort.scanner import Scanner
from heartfit.geometry.arrays import Floats
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.imaging.grid import Grid


class ScanPlan:
    """Slices across ``axes`` (3,3), columns i, j, k, that fill the box from ``low`` to ``high`` (3,), m along them.

    grid, fine: the scan's voxels and the finer ones; across, pitch: fine voxels in a voxel along i and j, and from
    slice to slice; inside: those along k within a slice, the others lie in the gap.
    """

    def __init__(self, low: Floats, high: Floats, axes: Floats, scanner: Scanner) -> None:
        step = scanner.slice_thickness + scanner.slice_gap
        self.across = max(1, round(scanner.voxel / scanner.subvoxel))
        self.pitch = max(1, round(step / scanner.subvoxel))
        self.inside = max(1, round(self.pitch * scanner.slice_thickness / step))
        spacing = np.array([scanner.voxel, scanner.voxel, step])
        size = np.ceil((high - low) / spacing).astype(int)
        parts = np.array([self.across, self.across, self.pitch])
        averaged = np.array([self.across, self.across, self.inside])
        origin = low + 0.5 * spacing / parts
        self.fine = _grid(size * parts, spacing / parts, origin, axes)
        self.grid = _grid(size, spacing, origin + 0.5 * (averaged - 1) * spacing / parts, axes)

    @classmethod
    def about(cls, mesh: VentricularMesh, axes: LeftVentricularAxes, scanner: Scanner) -> "ScanPlan":
        """Short-axis slices that hold the mesh and a margin about it."""
        directions = np.column_stack([axes.septal, axes.anterior, axes.axis])
        along = mesh.points @ directions
        return cls(
            along.min(axis=0) - scanner.margin, along.max(axis=0) + scanner.margin, directions, scanner
        )

    def mean(self, image: Floats) -> Floats:
        """What the scan's voxels (k,j,i) show of an image on the fine ones."""
        starts = product(range(self.inside), range(self.across), range(self.across))
        parts = [image[k :: self.pitch, j :: self.across, i :: self.across] for k, j, i in starts]
        mean: Floats = reduce(np.add, parts) / len(parts)
        return mean


def _grid(size: Floats, spacing: Floats, low: Floats, axes: Floats) -> Grid:
    i, j, k = map(int, size)
    return Grid((i, j, k), spacing, axes @ low, axes)
