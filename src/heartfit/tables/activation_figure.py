"""When the wall is activated: on its surface, in a cut and by segment (Fig. 3 left and Fig. 4 left of the paper)."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from heartfit.geometry.arrays import Floats
from heartfit.geometry.bullseye import RIGHT_VENTRICLE
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.polygons import Polygon, bands
from heartfit.tables.bullseye import draw_bullseye
from heartfit.tables.painting import TIME, Side, half, paint, surface

ISOCHRONES = 10.0
"""ms between them."""

ONSETS = {"healthy": "onset on both sides", "lbbb": "left bundle branch block, onset on the right side only"}


def plot_activation(mesh: VentricularMesh, conduction: str, case: str) -> Figure:
    """The activation of a mesh from the front, cut along its long axis, from the left, and as a bullseye.

    conduction: "healthy" or "lbbb". The edges of the colours are isochrones.
    """
    times, means = nodal_means(mesh), segment_means(mesh)
    levels = np.arange(0.0, 1e3 * times.max() + ISOCHRONES, ISOCHRONES)
    scale = ScalarMappable(BoundaryNorm(levels, 256), colormaps["RdYlBu"])
    figure = Figure(figsize=(13, 4), layout="constrained")
    first, *others, segments = figure.subplots(1, 4, width_ratios=(1, 1, 1, 1.2))
    for axes in others:
        axes.sharex(first)
        axes.sharey(first)
    for axes, (name, (side, polygons)) in zip((first, *others), _views(mesh, times).items(), strict=True):
        paint(axes, side, *_coloured(polygons, levels, scale))
        axes.set_title(name, fontsize=9)
    colours = scale.to_rgba(np.array(list(means.values())))
    draw_bullseye(segments, dict(zip(means, zip(means.values(), colours, strict=True), strict=True)))
    segments.set_title(
        f"mean of each segment (ms),\nof the right free wall {means[RIGHT_VENTRICLE]:.0f}", fontsize=9
    )
    figure.colorbar(scale, ax=segments, label="activation time (ms)", shrink=0.8)
    total = 1e3 * np.asarray(mesh.activation).max()
    figure.suptitle(f"{case}: {ONSETS[conduction]}; active throughout after {total:.0f} ms", fontsize=11)
    return figure


def nodal_means(mesh: VentricularMesh) -> Floats:
    """Activation time (n,) in s at the nodes, the mean of their tetrahedra weighted by volume."""
    weight = np.repeat(mesh.element_volumes(), 4)
    nodes, count = mesh.tets.ravel(), len(mesh.points)
    times = np.bincount(nodes, weight * np.repeat(np.asarray(mesh.activation), 4), count)
    means: Floats = times / np.bincount(nodes, weight, count)
    return means


def segment_means(mesh: VentricularMesh) -> Mapping[int, float]:
    """Mean activation time in ms of each AHA segment that the mesh has, and of the right free wall as segment 0."""
    volumes, segments = mesh.element_volumes(), np.asarray(mesh.segments)
    return {
        int(each): 1e3
        * float(np.average(np.asarray(mesh.activation)[segments == each], weights=volumes[segments == each]))
        for each in np.unique(segments)
    }


def _views(mesh: VentricularMesh, times: Floats) -> Mapping[str, tuple[Side, Sequence[Polygon]]]:
    """What is seen from where, by what it is called."""
    axes = LeftVentricularAxes.of(mesh)
    frame = np.array([axes.septal, axes.anterior, axes.axis])
    along = mesh.points @ frame.T
    centre = 0.5 * (along.min(axis=0) + along.max(axis=0)) @ frame
    front, left = (Side(-axis, axes.axis, centre) for axis in (axes.septal, axes.anterior))
    middle = mesh.points[np.unique(mesh.surfaces["lv_endo"])].mean(axis=0)
    outside = surface(mesh, times)
    return {
        "from the front": (front, outside),
        "cut through both ventricles": (front, half(mesh, times, middle, axes.anterior)),
        "from the left": (left, outside),
    }


def _coloured(
    polygons: Sequence[Polygon], levels: Floats, scale: ScalarMappable
) -> tuple[list[Polygon], Floats]:
    """The polygons split at the isochrones, ms, and the colour (k,3) of each."""
    parts = [part for polygon in polygons for part in bands(polygon, TIME, 1e-3 * levels)]
    middles = 0.5 * (levels[:-1] + levels[1:])
    colours: Floats = scale.to_rgba(middles)[[band for band, _ in parts], :3]
    return [part for _, part in parts], colours
