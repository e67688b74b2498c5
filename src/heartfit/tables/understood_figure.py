"""What was understood of a measured heart before anything is run: surfaces over images, curves, fibres and onset."""

from dataclasses import dataclass

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure, FigureBase

from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.imaging.sequence import ImageSequence
from heartfit.imaging.view import views
from heartfit.observation.curve import Curve
from heartfit.observation.recorded_pressure import AveragedPressure
from heartfit.observation.volumes import cavity_volumes
from heartfit.tables.activation_figure import ISOCHRONES, ONSETS, nodal_means
from heartfit.tables.contours import SIDES
from heartfit.tables.figures import CALIBRATED, REFERENCE, clean
from heartfit.tables.overlay import COLOURS, OUTLINES, draw_key
from heartfit.tables.painting import Side, paint, surface
from heartfit.tables.patient_view import draw_view

HALF_FIBRE = 2.5e-3
"""m of the strokes that stand for fibres."""


@dataclass(frozen=True, eq=False)
class Understood:
    """A measured case as it was read: a coarse mesh at end diastole and, where they are there, its motion, images and
    pressure; conduction "healthy" or "lbbb".
    """

    name: str
    conduction: str
    mesh: VentricularMesh
    motion: Motion | None
    images: ImageSequence | None
    pressure: AveragedPressure | None

    @property
    def volumes(self) -> dict[str, Curve]:
        """Of both cavities, by "lv" and "rv", m^3."""
        curves = {} if self.motion is None else cavity_volumes(self.mesh, self.motion)
        return {side: curves[f"{side}_volume"] for side in SIDES if f"{side}_volume" in curves}

    @property
    def end_systole(self) -> int:
        """The phase of the least left volume; without motion, the frame that is least like end diastole."""
        if self.motion is not None:
            return int(self.volumes["lv"].values.argmin())
        assert self.images is not None
        voxels = self.images.voxels
        return int(np.abs(voxels - voxels[0]).mean(axis=(1, 2, 3)).argmax())


def plot_understood(heart: Understood) -> Figure:
    """Surfaces over images at end diastole and end systole; below volumes, pressure, loop, activation and fibres."""
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
    figure.suptitle(f"{heart.name}, as it was read", fontsize=12)
    return figure


def _pictures(figure: FigureBase, heart: Understood, images: ImageSequence) -> None:
    named = views(images.grid, heart.mesh)
    late = heart.end_systole
    moved = heart.mesh.points if heart.motion is None else heart.motion.positions[late]
    titles = (
        "end diastole",
        "end systole" if heart.motion else "least like it, outlines as above",
    )
    panels = figure.subplots(2, len(named))
    for row, title, frame, points in zip(panels, titles, (0, late), (heart.mesh.points, moved), strict=True):
        for axes, (what, view) in zip(row, named.items(), strict=True):
            draw_view(axes, images, view, frame)
            for name, colour in COLOURS.items():
                lines = list(1e3 * view.outline(points, heart.mesh.surfaces[name]))
                axes.add_collection(LineCollection(lines, colors=colour, linewidths=1.3), autolim=False)
            axes.set_title(f"{title}, {1e3 * images.times[frame]:.0f} ms: {what}", fontsize=9)
    draw_key(figure, dict(OUTLINES.values()))


def _volumes(axes: Axes, heart: Understood) -> None:
    for side, curve in heart.volumes.items():
        label, colour = SIDES[side]
        axes.plot(curve.times, 1e6 * curve.values, ".-", color=colour, linewidth=1.2, label=label)
    if heart.volumes:
        axes.set_ylim(bottom=0.0)
        axes.legend(frameon=False, fontsize=8, loc="lower right")
    else:
        _absent(axes, "volumes follow\nfrom registration")
    _label(axes, "time after trigger (s)", "volume (mL)", "volumes of the surfaces")


def _pressures(axes: Axes, pressure: AveragedPressure | None) -> None:
    if pressure is None:
        _absent(axes, "no pressure given")
        _label(axes, "time after trigger (s)", "pressure (kPa)", "left ventricular pressure")
        return
    times = pressure.curve.times
    for beat, kept in zip(pressure.beats, pressure.kept, strict=True):
        axes.plot(times, 1e-3 * beat, color=REFERENCE, linestyle="-" if kept else ":", linewidth=0.7)
    axes.plot(times, 1e-3 * pressure.curve.values, color=CALIBRATED, linewidth=1.8)
    counted = f"mean of {int(pressure.kept.sum())} of {len(pressure.kept)} beats"
    _label(axes, "time after trigger (s)", "pressure (kPa)", f"left ventricular pressure,\n{counted}")


def _loop(axes: Axes, heart: Understood) -> None:
    if heart.pressure is None or not heart.volumes:
        _absent(axes, "needs volume\nand pressure")
    else:
        volume = heart.volumes["lv"]
        closed = np.append(np.arange(volume.times.size), 0)
        pressures = heart.pressure.curve(volume.times)[closed]
        axes.plot(1e6 * volume.values[closed], 1e-3 * pressures, ".-", color=CALIBRATED, linewidth=1.2)
    _label(axes, "volume (mL)", "pressure (kPa)", "loop")


def _activation(figure: FigureBase, axes: Axes, heart: Understood) -> None:
    times = nodal_means(heart.mesh)
    levels = np.arange(0.0, 1e3 * times.max() + ISOCHRONES, ISOCHRONES)
    scale = ScalarMappable(BoundaryNorm(levels, 256), colormaps["RdYlBu"])
    polygons = surface(heart.mesh, times)
    colours = scale.to_rgba(1e3 * np.array([polygon[:, 3].mean() for polygon in polygons]))[:, :3]
    paint(axes, _from_the_left(heart.mesh), polygons, colours)
    axes.set_title(f"{ONSETS[heart.conduction]},\nfrom the left", fontsize=9)
    figure.colorbar(scale, ax=axes, label="activation time (ms)", ticks=levels[::3], location="bottom")


def _fibres(axes: Axes, mesh: VentricularMesh) -> None:
    """Strokes along the fibres of the tetrahedra at the epicardium."""
    side = _from_the_left(mesh)
    polygons = surface(mesh, np.zeros(len(mesh.points)))
    paint(axes, side, polygons, np.full((len(polygons), 3), 0.85))
    outer = np.isin(mesh.tets, np.unique(mesh.surfaces["epi"])).sum(axis=1) >= 3
    centres, fibres = mesh.points[mesh.tets[outer]].mean(axis=1), np.asarray(mesh.fibres)[outer]
    seen = (centres - side.centre) @ side.towards > 0.0
    ends = np.stack([centres - HALF_FIBRE * fibres, centres + HALF_FIBRE * fibres], axis=1)[seen]
    flat = 1e3 * (ends - side.centre) @ np.stack([side.right, side.up], axis=1)
    axes.add_collection(LineCollection(list(flat), colors="black", linewidths=0.7))
    axes.set_title("fibres at the epicardium,\nfrom the left", fontsize=9)


def _from_the_left(mesh: VentricularMesh) -> Side:
    axes = LeftVentricularAxes.of(mesh)
    return Side(-axes.anterior, axes.axis, 0.5 * (mesh.points.min(axis=0) + mesh.points.max(axis=0)))


def _absent(axes: Axes, why: str) -> None:
    axes.text(0.5, 0.5, why, ha="center", va="center", transform=axes.transAxes, fontsize=9, color="#555555")
    axes.set_xticks([])
    axes.set_yticks([])


def _label(axes: Axes, x: str, y: str, title: str) -> None:
    axes.set_xlabel(x, fontsize=9)
    axes.set_ylabel(y, fontsize=9)
    axes.tick_params(labelsize=8)
    axes.set_title(title, fontsize=9)
    clean(axes)
