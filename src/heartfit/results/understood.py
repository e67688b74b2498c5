"""Figure of a heart as imported: surfaces over images, curves, activation and fibres, before any simulation."""

from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure, FigureBase

from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.sampling import views
from heartfit.imaging.sequence import ImageSequence
from heartfit.observation.curve import Curve
from heartfit.observation.recorded_pressure import AveragedPressure
from heartfit.observation.shape import cavity_volumes
from heartfit.results.activation import ISOCHRONE_SPACING, ONSETS, nodal_means
from heartfit.results.contours import SIDES, draw_view
from heartfit.results.drawing import Viewpoint, paint, wall_polygons
from heartfit.results.figures import CALIBRATED, REFERENCE, clean
from heartfit.results.overlay import COLOURS, OUTLINES, draw_key

HALF_STROKE = 2.5e-3
"""Half length of the strokes that show fibres [m]."""


@dataclass(frozen=True, eq=False)
class ImportedCase:
    """A measured case as imported: coarse mesh at end diastole, and motion, images and pressure if given.

    conduction: "healthy" or "lbbb".
    """

    name: str
    conduction: str
    mesh: VentricularMesh
    motion: Motion | None
    images: ImageSequence | None
    pressure: AveragedPressure | None

    @property
    def volumes(self) -> dict[str, Curve]:
        """Return the volumes of both cavities by "lv" and "rv" [m^3]."""
        curves = {} if self.motion is None else cavity_volumes(self.mesh, self.motion)
        return {side: curves[f"{side}_volume"] for side in SIDES if f"{side}_volume" in curves}

    @property
    def end_systole(self) -> int:
        """Return the phase of the least left volume; without motion, the frame least similar to end diastole."""
        if self.motion is not None:
            return int(self.volumes["lv"].values.argmin())
        assert self.images is not None
        voxels = self.images.voxels
        return int(np.abs(voxels - voxels[0]).mean(axis=(1, 2, 3)).argmax())


def plot_imported_case(heart: ImportedCase) -> Figure:
    """Plot surfaces over images at end diastole and end systole; below curves, activation and fibres."""
    figure = Figure(figsize=(13, 11 if heart.images else 4.5), layout="constrained")
    rows = figure.subfigures(
        2 if heart.images else 1, 1, height_ratios=(2, 1) if heart.images else None, squeeze=False
    )
    if heart.images is not None:
        _pictures(rows[0, 0], heart, heart.images)
    volume, pressure, loop, activation, fibres = rows[-1, 0].subplots(1, 5, width_ratios=(1.2, 1.2, 1, 1, 1))
    _volumes(volume, heart)
    _pressures(pressure, heart.pressure)
    _loop(loop, heart)
    _activation(rows[-1, 0], activation, heart)
    _fibres(fibres, heart.mesh)
    figure.suptitle(f"{heart.name} as imported", fontsize=12)
    return figure


def _pictures(figure: FigureBase, heart: ImportedCase, images: ImageSequence) -> None:
    named = views(images.grid, heart.mesh)
    end_systole = heart.end_systole
    end_systolic_points = heart.mesh.points if heart.motion is None else heart.motion.positions[end_systole]
    titles = (
        "end diastole",
        "end systole" if heart.motion else "least similar frame, outlines as above",
    )
    panels = figure.subplots(2, len(named))
    frames, positions = (0, end_systole), (heart.mesh.points, end_systolic_points)
    for row, title, frame, points in zip(panels, titles, frames, positions, strict=True):
        for axes, (view_name, view) in zip(row, named.items(), strict=True):
            draw_view(axes, images, view, frame)
            for name, colour in COLOURS.items():
                lines = list(1e3 * view.outline(points, heart.mesh.surfaces[name]))
                axes.add_collection(LineCollection(lines, colors=colour, linewidths=1.3), autolim=False)
            axes.set_title(f"{title}, {1e3 * images.times[frame]:.0f} ms: {view_name}", fontsize=9)
    draw_key(figure, dict(OUTLINES.values()))


def _volumes(axes: Axes, heart: ImportedCase) -> None:
    for side, curve in heart.volumes.items():
        label, colour = SIDES[side]
        axes.plot(curve.times, 1e6 * curve.values, ".-", color=colour, linewidth=1.2, label=label)
    if heart.volumes:
        axes.set_ylim(bottom=0.0)
        axes.legend(frameon=False, fontsize=8, loc="lower right")
    else:
        _absent(axes, "volumes need\nregistration")
    _label(axes, "time after trigger (s)", "volume (mL)", "volumes of the surfaces")


def _pressures(axes: Axes, pressure: AveragedPressure | None) -> None:
    if pressure is None:
        _absent(axes, "no pressure recorded")
        _label(axes, "time after trigger (s)", "pressure (kPa)", "left ventricular pressure")
        return
    times = pressure.curve.times
    for beat, kept in zip(pressure.beats, pressure.kept, strict=True):
        axes.plot(times, 1e-3 * beat, color=REFERENCE, linestyle="-" if kept else ":", linewidth=0.7)
    axes.plot(times, 1e-3 * pressure.curve.values, color=CALIBRATED, linewidth=1.8)
    counted = f"mean of {int(pressure.kept.sum())} of {len(pressure.kept)} beats"
    _label(axes, "time after trigger (s)", "pressure (kPa)", f"left ventricular pressure,\n{counted}")


def _loop(axes: Axes, heart: ImportedCase) -> None:
    if heart.pressure is None or not heart.volumes:
        _absent(axes, "loop needs volume\nand pressure")
    else:
        volume = heart.volumes["lv"]
        closed = np.append(np.arange(volume.times.size), 0)
        pressures = heart.pressure.curve(volume.times)[closed]
        axes.plot(1e6 * volume.values[closed], 1e-3 * pressures, ".-", color=CALIBRATED, linewidth=1.2)
    _label(axes, "volume (mL)", "pressure (kPa)", "loop")


def _activation(figure: FigureBase, axes: Axes, heart: ImportedCase) -> None:
    times = nodal_means(heart.mesh)
    levels = np.arange(0.0, 1e3 * times.max() + ISOCHRONE_SPACING, ISOCHRONE_SPACING)
    scale = ScalarMappable(BoundaryNorm(levels, 256), colormaps["RdYlBu"])
    polygons = wall_polygons(heart.mesh, times)
    colours = scale.to_rgba(1e3 * np.array([polygon[:, 3].mean() for polygon in polygons]))[:, :3]
    paint(axes, _from_the_left(heart.mesh), polygons, colours)
    axes.set_title(f"{ONSETS[heart.conduction]},\nfrom the left", fontsize=9)
    figure.colorbar(scale, ax=axes, label="activation time (ms)", ticks=levels[::3], location="bottom")


def _fibres(axes: Axes, mesh: VentricularMesh) -> None:
    """Draw strokes along the fibres of the tetrahedra at the epicardium."""
    side = _from_the_left(mesh)
    polygons = wall_polygons(mesh, np.zeros(len(mesh.points)))
    paint(axes, side, polygons, np.full((len(polygons), 3), 0.85))
    outer = np.isin(mesh.tets, np.unique(mesh.surfaces["epi"])).sum(axis=1) >= 3
    centres, fibres = mesh.points[mesh.tets[outer]].mean(axis=1), np.asarray(mesh.fibres)[outer]
    visible = (centres - side.centre) @ side.towards > 0.0
    ends = np.stack([centres - HALF_STROKE * fibres, centres + HALF_STROKE * fibres], axis=1)[visible]
    flat = 1e3 * (ends - side.centre) @ np.stack([side.right, side.up], axis=1)
    axes.add_collection(LineCollection(list(flat), colors="black", linewidths=0.7))
    axes.set_title("fibres at the epicardium,\nfrom the left", fontsize=9)


def _from_the_left(mesh: VentricularMesh) -> Viewpoint:
    axes = LeftVentricularAxes.from_mesh(mesh)
    return Viewpoint(-axes.anterior, axes.axis, 0.5 * (mesh.points.min(axis=0) + mesh.points.max(axis=0)))


def _absent(axes: Axes, reason: str) -> None:
    axes.text(
        0.5, 0.5, reason, ha="center", va="center", transform=axes.transAxes, fontsize=9, color="#555555"
    )
    axes.set_xticks([])
    axes.set_yticks([])


def _label(axes: Axes, x: str, y: str, title: str) -> None:
    axes.set_xlabel(x, fontsize=9)
    axes.set_ylabel(y, fontsize=9)
    axes.tick_params(labelsize=8)
    axes.set_title(title, fontsize=9)
    clean(axes)
