"""Planes through an image on which picture and mesh are looked at together."""

from dataclasses import dataclass

import numpy as np
from scipy.ndimage import map_coordinates

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.cut import cut
from heartfit.geometry.mesh import VentricularMesh
from heartfit.imaging.grid import Grid

SURROUNDINGS = 15e-3
"""What is seen about the mesh, m."""


@dataclass(frozen=True, eq=False)
class View:
    """A rectangle in space: origin (3,) m, unit vectors right and up (3,), low and high (2,) m along them."""

    origin: Floats
    right: Floats
    up: Floats
    low: Floats
    high: Floats

    def picture(self, image: Floats, grid: Grid, pixel: float) -> Floats:
        """Brightness (rows upwards, columns) at pixels of this width, m, linear between voxels, 0 outside the image."""
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
        """Segments (s,2,2) in m along right and up where the plane cuts the triangles."""
        segments = cut(points, triangles, self.origin, np.cross(self.right, self.up)) - self.origin
        return np.stack([segments @ self.right, segments @ self.up], axis=-1)


def views(grid: Grid, mesh: VentricularMesh) -> dict[str, View]:
    """Three planes through the left ventricle: a slice of the images, and two across all slices.

    The first is the slice nearest to the middle of the left ventricle's axis, as the scanner shows it. The other two
    meet it at right angles in that point, the base above: one towards the septum (or, if the slices lie along it,
    the apex), one across. For short-axis images they are near the planes of four and of two chambers.
    """
    axes = LeftVentricularAxes.of(mesh)
    i, j, k = grid.direction.T
    up = k if k @ axes.axis > 0.0 else -k
    aside = [direction - (direction @ up) * up for direction in (axes.septal, axes.axis)]
    across = max(aside, key=lambda vector: float(vector @ vector))
    across = across / np.linalg.norm(across)
    middle = axes.apex + 0.5 * axes.length * axes.axis
    index = grid.index(middle)
    index[2] = np.clip(np.round(index[2]), 0, grid.size[2] - 1)
    return {
        "slice": _about(mesh, grid.points(index), i, -j),
        "towards the septum": _about(mesh, middle, -across, up),
        "along the septum": _about(mesh, middle, np.cross(across, up), up),
    }


def _about(mesh: VentricularMesh, origin: Floats, right: Floats, up: Floats) -> View:
    """The view that shows all of the mesh and something about it."""
    seen = (mesh.points - origin) @ np.column_stack([right, up])
    return View(origin, right, up, seen.min(axis=0) - SURROUNDINGS, seen.max(axis=0) + SURROUNDINGS)
