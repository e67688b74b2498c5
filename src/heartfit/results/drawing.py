"""Shaded views of the ventricles and the bull's-eye of the left ventricle.

The bull's-eye shows the 17 AHA segments: apex in the middle, anterior on top, septum on the left.

References
----------
Cerqueira MD et al. 2002, doi 10.1161/hc0402.102975.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.patches import Wedge

from heartfit.core.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.sections import Polygon, clip_polygon, tetrahedra_sections
from heartfit.geometry.surface import triangle_normals

TIME, NORMAL = 3, slice(4, 7)
"""Columns of a polygon: activation time [s] and outward normal."""

AMBIENT_LIGHT = 0.65
"""Brightness of surfaces that face away from the light."""


@dataclass(frozen=True, eq=False)
class Viewpoint:
    """Direction of view: unit vectors (3,) to the right and upwards in the picture, and its centre (3,) [m]."""

    right: Floats
    up: Floats
    centre: Floats

    @property
    def towards(self) -> Floats:
        """Return the unit vector towards the viewer."""
        return np.cross(self.right, self.up)

    @property
    def light(self) -> Floats:
        """Return the unit vector towards the light, above the viewer's left shoulder."""
        light = self.towards - 0.5 * self.right + 0.6 * self.up
        return light / np.linalg.norm(light)


def paint(axes: Axes, side: Viewpoint, polygons: Sequence[Polygon], colours: Floats) -> None:
    """Draw polygons [mm] with their colours (k, 3); polygons that face away are omitted."""
    facing = np.array([polygon[:, NORMAL].mean(axis=0) for polygon in polygons])
    depth = np.array([polygon[:, :3].mean(axis=0) @ side.towards for polygon in polygons])
    visible = np.flatnonzero(facing @ side.towards > 0.0)
    order = visible[np.argsort(depth[visible])]
    shade = AMBIENT_LIGHT + (1.0 - AMBIENT_LIGHT) * np.clip(facing @ side.light, 0.0, 1.0)
    flat = np.stack([side.right, side.up], axis=1)
    outlines = [1e3 * (polygons[i][:, :3] - side.centre) @ flat for i in order]
    lit = (shade[:, None] * colours)[order]
    axes.add_collection(
        PolyCollection(outlines, facecolors=lit, edgecolors=lit, linewidths=0.3, rasterized=True)
    )
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.set_axis_off()


def wall_polygons(mesh: VentricularMesh, times: Floats) -> list[Polygon]:
    """Return the triangles of the surface of the wall with time (n,) and mean normal at each corner."""
    polygons: list[Polygon] = []
    for triangles in mesh.surfaces.values():
        normals = np.zeros_like(mesh.points)
        np.add.at(normals, triangles.T, triangle_normals(mesh.points, triangles))
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
        polygons += list(np.column_stack([mesh.points, times, normals])[triangles])
    return polygons


def cut_surface(mesh: VentricularMesh, times: Floats, origin: Floats, normal: Floats) -> list[Polygon]:
    """Return the surface behind the plane through ``origin`` with this normal (3,), and the cut wall."""
    behind = [
        clip_polygon(polygon, (origin - polygon[:, :3]) @ normal) for polygon in wall_polygons(mesh, times)
    ]
    corners = np.column_stack([mesh.points, times, np.tile(normal, (len(times), 1))])
    cut = tetrahedra_sections(corners, mesh.tets, (origin - mesh.points) @ normal)
    return [polygon for polygon in behind if len(polygon) > 2] + list(cut)


RINGS = (  # first segment, number of segments, start of the first [degrees], inner and outer radius
    (1, 6, 60.0, 0.75, 1.0),
    (7, 6, 60.0, 0.5, 0.75),
    (13, 4, 45.0, 0.25, 0.5),
    (17, 1, 0.0, 0.0, 0.25),
)
WALLS = {"anterior": (0, 1.1, 0), "inferior": (0, -1.1, 0), "septal": (-1.1, 0, 90), "lateral": (1.1, 0, -90)}
"""Position of the name of each wall, and its rotation [degrees]."""


def draw_bullseye(axes: Axes, values: Mapping[int, tuple[float, Floats]]) -> None:
    """Draw the AHA segments with their rounded values and colours; segments without a value are omitted."""
    for first, count, start, inner, outer in RINGS:
        width = 360.0 / count
        for segment in set(range(first, first + count)) & set(values):
            begin = start + (segment - first) * width
            _draw_segment(axes, (begin, begin + width), (inner, outer), *values[segment])
    for name, (x, y, turn) in WALLS.items():
        axes.text(x, y, name, ha="center", va="center", fontsize=8, rotation=turn)
    axes.set(xlim=(-1.2, 1.2), ylim=(-1.2, 1.2), aspect="equal")
    axes.set_axis_off()


def _draw_segment(
    axes: Axes, angles: tuple[float, float], radii: tuple[float, float], value: float, colour: Floats
) -> None:
    inner, outer = radii
    axes.add_patch(Wedge((0, 0), outer, *angles, width=outer - inner, facecolor=colour, edgecolor="white"))
    angle, radius = np.deg2rad(np.mean(angles)), 0.5 * (inner + outer) if inner else 0.0
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    axes.text(x, y, f"{value:.0f}", ha="center", va="center", fontsize=8)
