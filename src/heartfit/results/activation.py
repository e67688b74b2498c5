"""Activation times of the wall: on its surface, in a cut and by segment (Fig. 3 left and Fig. 4 left of the paper)."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.sections import Polygon, split_into_bands
from heartfit.geometry.territory import RIGHT_VENTRICLE
from heartfit.results.drawing import TIME, Viewpoint, cut_surface, draw_bullseye, paint, wall_polygons

ISOCHRONE_SPACING = 10.0
"""Time between isochrones [ms]."""

ONSETS = {"healthy": "onset on both sides", "lbbb": "left bundle branch block, onset on the right side only"}


def plot_activation(mesh: VentricularMesh, conduction: str, case: str) -> Figure:
    """Plot the activation of a mesh from the front, cut along its long axis, from the left, and as a bullseye.

    conduction: "healthy" or "lbbb". Boundaries between colours are isochrones.
    """
    times, means = nodal_means(mesh), segment_means(mesh)
    levels = np.arange(0.0, 1e3 * times.max() + ISOCHRONE_SPACING, ISOCHRONE_SPACING)
    scale = ScalarMappable(BoundaryNorm(levels, 256), colormaps["RdYlBu"])
    figure = Figure(figsize=(13, 4), layout="constrained")
    first, *other_panels, segments = figure.subplots(1, 4, width_ratios=(1, 1, 1, 1.2))
    for axes in other_panels:
        axes.sharex(first)
        axes.sharey(first)
    for axes, (name, (side, polygons)) in zip(
        (first, *other_panels), _views(mesh, times).items(), strict=True
    ):
        paint(axes, side, *_isochrone_bands(polygons, levels, scale))
        axes.set_title(name, fontsize=9)
    colours = scale.to_rgba(np.array(list(means.values())))
    draw_bullseye(segments, dict(zip(means, zip(means.values(), colours, strict=True), strict=True)))
    segments.set_title(
        f"mean of each segment (ms),\nright free wall {means[RIGHT_VENTRICLE]:.0f}", fontsize=9
    )
    figure.colorbar(scale, ax=segments, label="activation time (ms)", shrink=0.8)
    total = 1e3 * np.asarray(mesh.activation).max()
    figure.suptitle(f"{case}: {ONSETS[conduction]}; fully active after {total:.0f} ms", fontsize=11)
    return figure


def nodal_means(mesh: VentricularMesh) -> Floats:
    """Return the activation time (n,) [s] of each node: mean over its tetrahedra weighted by volume."""
    weight = np.repeat(mesh.element_volumes(), 4)
    nodes, count = mesh.tets.ravel(), len(mesh.points)
    times = np.bincount(nodes, weight * np.repeat(np.asarray(mesh.activation), 4), count)
    means: Floats = times / np.bincount(nodes, weight, count)
    return means


def segment_means(mesh: VentricularMesh) -> Mapping[int, float]:
    """Return the mean activation time [ms] of each AHA segment of the mesh; segment 0 is the right free wall."""
    volumes, segments = mesh.element_volumes(), np.asarray(mesh.segments)
    return {
        int(segment): 1e3
        * float(
            np.average(np.asarray(mesh.activation)[segments == segment], weights=volumes[segments == segment])
        )
        for segment in np.unique(segments)
    }


def _views(mesh: VentricularMesh, times: Floats) -> Mapping[str, tuple[Viewpoint, Sequence[Polygon]]]:
    """Return viewpoint and polygons of each view by name."""
    axes = LeftVentricularAxes.from_mesh(mesh)
    frame = np.array([axes.septal, axes.anterior, axes.axis])
    along = mesh.points @ frame.T
    centre = 0.5 * (along.min(axis=0) + along.max(axis=0)) @ frame
    front, left = (Viewpoint(-axis, axes.axis, centre) for axis in (axes.septal, axes.anterior))
    middle = mesh.points[np.unique(mesh.surfaces["lv_endo"])].mean(axis=0)
    outside = wall_polygons(mesh, times)
    return {
        "from the front": (front, outside),
        "cut through both ventricles": (front, cut_surface(mesh, times, middle, axes.anterior)),
        "from the left": (left, outside),
    }


def _isochrone_bands(
    polygons: Sequence[Polygon], levels: Floats, scale: ScalarMappable
) -> tuple[list[Polygon], Floats]:
    """Return the polygons split at the isochrones [ms], and the colour (k, 3) of each part."""
    parts = [part for polygon in polygons for part in split_into_bands(polygon, TIME, 1e-3 * levels)]
    middles = 0.5 * (levels[:-1] + levels[1:])
    colours: Floats = scale.to_rgba(middles)[[band for band, _ in parts], :3]
    return [part for _, part in parts], colours
