"""The heart from one side, as a painter would: shaded polygons, the far ones first."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection

from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.polygons import Polygon, clipped, sections
from heartfit.geometry.surface import triangle_normals

TIME, NORMAL = 3, slice(4, 7)
"""Columns of a polygon: the time of activation, s, and the outward normal."""

AMBIENT = 0.65
"""Brightness of what turns away from the light."""


@dataclass(frozen=True, eq=False)
class Side:
    """Where to look from: unit vectors (3,) to the right and upwards in the picture, and its centre (3,), m."""

    right: Floats
    up: Floats
    centre: Floats

    @property
    def towards(self) -> Floats:
        """To the beholder."""
        return np.cross(self.right, self.up)

    @property
    def light(self) -> Floats:
        """To the lamp, above the beholder's left shoulder."""
        light = self.towards - 0.5 * self.right + 0.6 * self.up
        return light / np.linalg.norm(light)


def paint(axes: Axes, side: Side, polygons: Sequence[Polygon], colours: Floats) -> None:
    """Draw polygons, each with its colour (k,3), in mm; what faces away is left out."""
    facing = np.array([polygon[:, NORMAL].mean(axis=0) for polygon in polygons])
    depth = np.array([polygon[:, :3].mean(axis=0) @ side.towards for polygon in polygons])
    seen = np.flatnonzero(facing @ side.towards > 0.0)
    order = seen[np.argsort(depth[seen])]
    shade = AMBIENT + (1.0 - AMBIENT) * np.clip(facing @ side.light, 0.0, 1.0)
    flat = np.stack([side.right, side.up], axis=1)
    outlines = [1e3 * (polygons[i][:, :3] - side.centre) @ flat for i in order]
    lit = (shade[:, None] * colours)[order]
    axes.add_collection(
        PolyCollection(outlines, facecolors=lit, edgecolors=lit, linewidths=0.3, rasterized=True)
    )
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()


def surface(mesh: VentricularMesh, times: Floats) -> list[Polygon]:
    """The triangles of the wall's surface with the time (n,) and the mean normal at each corner."""
    polygons: list[Polygon] = []
    for triangles in mesh.surfaces.values():
        normals = np.zeros_like(mesh.points)
        np.add.at(normals, triangles.T, triangle_normals(mesh.points, triangles))
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
        polygons += list(np.column_stack([mesh.points, times, normals])[triangles])
    return polygons


def half(mesh: VentricularMesh, times: Floats, origin: Floats, normal: Floats) -> list[Polygon]:
    """The surface of what lies behind the plane through ``origin``, with the cut wall, of that normal (3,)."""
    behind = [clipped(each, (origin - each[:, :3]) @ normal) for each in surface(mesh, times)]
    corners = np.column_stack([mesh.points, times, np.tile(normal, (len(times), 1))])
    cut = sections(corners, mesh.tets, (origin - mesh.points) @ normal)
    return [each for each in behind if len(each) > 2] + list(cut)
