"""Resampled and cropped images, and planes through a mesh."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.ndimage import map_coordinates

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.sections import cut_surface
from heartfit.imaging.sequence import Grid, ImageSequence

CUBIC_TOLERANCE = 0.01
"""Largest relative difference between the spacings of voxels that count as cubic."""
ROUNDING = 1e-6
"""Rounding of positions [voxels]: a voxel on the edge of a box is in it whatever the last bits of the edge are."""
VIEW_MARGIN = 15e-3
"""Width [m] of the surroundings of the mesh that a view shows."""


def resample_isotropic(sequence: ImageSequence) -> ImageSequence:
    """Interpolate a sequence linearly onto cubic voxels of its finest spacing; return it if they are cubic."""
    grid = sequence.grid
    unit = float(grid.spacing.min())
    if (np.abs(grid.spacing / unit - 1.0) < CUBIC_TOLERANCE).all():
        return sequence
    last = np.array(grid.size) - 1
    i, j, k = np.floor(last * grid.spacing / unit + 1e-9).astype(int) + 1
    cubic = Grid((int(i), int(j), int(k)), np.full(3, unit), grid.origin, grid.direction)
    steps = unit / grid.spacing[::-1]
    index = np.indices(cubic.shape) * steps[:, None, None, None]
    voxels = np.array([_linear(frame, index) for frame in sequence.voxels])
    return replace(sequence, grid=cubic, voxels=voxels)


def crop(sequence: ImageSequence, points: Floats, margin: float) -> ImageSequence:
    """Return the present voxels within ``margin`` [m] of the box that holds the points (n, 3) [m]."""
    index, step = sequence.grid.index(points), margin / sequence.grid.spacing
    first = np.maximum(np.floor(index.min(axis=0) - step + ROUNDING).astype(int), 0)
    last = np.minimum(
        np.ceil(index.max(axis=0) + step - ROUNDING).astype(int), np.array(sequence.grid.size) - 1
    )
    i, j, k = (slice(a, b + 1) for a, b in zip(first.tolist(), last.tolist(), strict=True))
    size = last - first + 1
    origin = sequence.grid.points(first.astype(float))
    grid = replace(sequence.grid, size=(int(size[0]), int(size[1]), int(size[2])), origin=origin)
    return replace(sequence, grid=grid, voxels=sequence.voxels[:, k, j, i])


def _linear(frame: Floats, index: Floats) -> Floats:
    values: Floats = map_coordinates(frame, index, order=1, mode="nearest")
    return values


@dataclass(frozen=True, eq=False)
class View:
    """Rectangle in space: origin (3,) [m], unit vectors right and up (3,), low and high (2,) [m] along them."""

    origin: Floats
    right: Floats
    up: Floats
    low: Floats
    high: Floats

    def picture(self, image: Floats, grid: Grid, pixel: float) -> Floats:
        """Brightness (rows upwards, columns) at pixels of this width [m]: linear between voxels, 0 beyond."""
        count = np.maximum(np.round((self.high - self.low) / pixel).astype(int), 1)
        across, along = (
            low + (np.arange(n) + 0.5) * (high - low) / n
            for low, high, n in zip(self.low, self.high, count, strict=True)
        )
        places = self.origin + along[:, None, None] * self.up + across[None, :, None] * self.right
        index = np.moveaxis(grid.index(places), -1, 0)[::-1]
        picture: Floats = map_coordinates(image, index, order=1, mode="grid-constant", cval=0.0)
        return picture

    def outline(self, points: Floats, triangles: Integers) -> Floats:
        """Segments (s, 2, 2) [m] along right and up in which the plane cuts the triangles."""
        segments = cut_surface(points, triangles, self.origin, np.cross(self.right, self.up)) - self.origin
        return np.stack([segments @ self.right, segments @ self.up], axis=-1)


def views(grid: Grid, mesh: VentricularMesh) -> dict[str, View]:
    """Views of three planes through the left ventricle: a slice of the images, and two across all slices.

    The first is the slice nearest to the middle of the left ventricular axis, as the scanner shows it. The other two
    meet it at right angles in that point, with the base above: one towards the septum (or, if the slices lie along it,
    the apex), one across. For short-axis images they are close to the four-chamber and two-chamber planes.
    """
    axes = LeftVentricularAxes.from_mesh(mesh)
    i, j, k = grid.direction.T
    up = k if k @ axes.axis > 0.0 else -k
    candidates = [direction - (direction @ up) * up for direction in (axes.septal, axes.axis)]
    across = max(candidates, key=lambda vector: float(vector @ vector))
    across = across / np.linalg.norm(across)
    middle = axes.apex + 0.5 * axes.length * axes.axis
    index = grid.index(middle)
    index[2] = np.clip(np.round(index[2]), 0, grid.size[2] - 1)
    return {
        "slice": _view_about(mesh, grid.points(index), i, -j),
        "towards the septum": _view_about(mesh, middle, -across, up),
        "along the septum": _view_about(mesh, middle, np.cross(across, up), up),
    }


def _view_about(mesh: VentricularMesh, origin: Floats, right: Floats, up: Floats) -> View:
    """Return the view that shows all of the mesh and VIEW_MARGIN about it."""
    extent = (mesh.points - origin) @ np.column_stack([right, up])
    return View(origin, right, up, extent.min(axis=0) - VIEW_MARGIN, extent.max(axis=0) + VIEW_MARGIN)
