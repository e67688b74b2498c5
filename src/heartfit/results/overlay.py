"""A moving mesh over images of the same phases."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure, FigureBase
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.geometry.carry import surface_distances
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.sampling import View, views
from heartfit.imaging.sequence import ImageSequence
from heartfit.observation.shape import cavity_volumes

OUTLINES = {"lv_endo": ("left endocardium", "#D55E00"), "rv_endo": ("right endocardium", "#56B4E9")}
OUTLINES |= {"epi": ("epicardium", "#F0E442")}
COLOURS = {name: colour for name, (_, colour) in OUTLINES.items()}
PIXEL = 0.7e-3
"""Width of a pixel of the pictures [m]."""

WHITE_PERCENTILE = 99.5
"""Percentile of the brightness of a view at end diastole that is white."""

TIME_TOLERANCE = 1e-3
"""Largest difference between a phase and its frame, over the period."""


@dataclass(frozen=True, eq=False)
class Overlay:
    """Images and the motion of a mesh in the same phases; raises InputError for different times."""

    sequence: ImageSequence
    mesh: VentricularMesh
    motion: Motion

    def __post_init__(self) -> None:
        frames, phases = self.sequence.times, self.motion.times
        if (
            frames.shape != phases.shape
            or np.abs(frames - phases).max() > TIME_TOLERANCE * self.motion.period
        ):
            raise InputError(
                f"overlay: {len(phases)} phases of the motion, {len(frames)} frames of the images; expected the same "
                "times: use the images that the motion was registered from"
            )

    @cached_property
    def volumes(self) -> Mapping[str, Floats]:
        """Return the volume (p,) of each cavity by "lv" and "rv" [m^3]."""
        curves = cavity_volumes(self.mesh, self.motion)
        return {side: curves[f"{side}_volume"].values for side in ("lv", "rv")}

    @property
    def end_systole(self) -> int:
        """Return the phase of the least left volume."""
        return int(self.volumes["lv"].argmin())

    @cached_property
    def views(self) -> Mapping[str, View]:
        """Return planes through the left ventricle by name."""
        return views(self.sequence.grid, self.mesh)


class Panel:
    """One view of an overlay in axes, for any phase."""

    def __init__(
        self, axes: Axes, overlay: Overlay, view: View, colours: Mapping[str, str] = COLOURS
    ) -> None:
        self.overlay, self.view = overlay, view
        left, bottom, right, top = 1e3 * np.array([*view.low, *view.high])
        self.image: AxesImage = axes.imshow(
            self._picture(0),
            cmap="gray",
            origin="lower",
            extent=(left, right, bottom, top),
            interpolation="nearest",
        )
        self.image.set_clim(0.0, float(np.percentile(self._picture(0), WHITE_PERCENTILE)))
        self.outlines = Outlines(axes, overlay, view, colours)
        axes.set_axis_off()

    def show(self, phase: int) -> None:
        """Show the image and the cut of the mesh in this phase [mm from the origin of the view]."""
        self.image.set_data(self._picture(phase))
        self.outlines.show(phase)

    def _picture(self, phase: int) -> Floats:
        sequence = self.overlay.sequence
        return self.view.picture(sequence.voxels[phase], sequence.grid, PIXEL)


class Outlines:
    """Cut of a view through the surfaces of an overlay in axes, for any phase; colours by surface."""

    def __init__(self, axes: Axes, overlay: Overlay, view: View, colours: Mapping[str, str]) -> None:
        self.overlay, self.view = overlay, view
        self.lines = {
            name: LineCollection([], colors=colour, linewidths=1.2) for name, colour in colours.items()
        }
        for line in self.lines.values():
            axes.add_collection(line, autolim=False)

    def show(self, phase: int) -> None:
        """Show the outlines in this phase [mm from the origin of the view]."""
        points = self.overlay.motion.positions[phase]
        for name, line in self.lines.items():
            line.set_segments(list(1e3 * self.view.outline(points, self.overlay.mesh.surfaces[name])))


def draw_phases(
    figure: FigureBase, overlay: Overlay, colours: Mapping[str, str] = COLOURS
) -> list[tuple[Panel, int]]:
    """Draw each view at end diastole (phase 0), and below at end systole; return the panels with their phases."""
    phases = {"end diastole": 0, "end systole": overlay.end_systole}
    shown = []
    for row, (name, phase) in zip(figure.subplots(2, len(overlay.views)), phases.items(), strict=True):
        for axes, (view_name, view) in zip(row, overlay.views.items(), strict=True):
            panel = Panel(axes, overlay, view, colours)
            panel.show(phase)
            axes.set_title(f"{name}, {1e3 * overlay.motion.times[phase]:.0f} ms: {view_name}", fontsize=9)
            shown.append((panel, phase))
    return shown


def draw_key(figure: FigureBase, colours: Mapping[str, str]) -> None:
    """Draw a legend of the colours below all panels."""
    lines = [Line2D([], [], color=colour, label=label) for label, colour in colours.items()]
    figure.legend(handles=lines, loc="outside lower center", ncols=len(lines), frameon=False, fontsize=9)


REGISTERED = "#56B4E9"  # the black of measured curves would be invisible on images


def plot_overlay(
    sequence: ImageSequence,
    mesh: VentricularMesh,
    registered: Motion,
    calibrated: Motion | None,
    title: str,
    colour: str,
) -> Figure:
    """Plot outlines of the registered and the calibrated motion at end diastole and at registered end systole.

    mesh: at end diastole; registered, calibrated: its motions at the frames of the images, None for a failed beat;
    colour: of the setting.
    Raises InputError for other times.
    """
    overlay = Overlay(sequence, mesh, registered)
    figure = Figure(figsize=(10, 7), layout="constrained")
    panels = draw_phases(figure, overlay, dict.fromkeys(OUTLINES, REGISTERED))
    draw_key(figure, {"registered": REGISTERED, "calibrated simulation": colour})
    summary = "the calibrated beat failed"
    if calibrated is not None:
        simulated = Overlay(sequence, mesh, calibrated)
        _draw_calibrated(panels, simulated, colour)
        summary = _endocardial_distance(overlay, simulated)
    figure.suptitle(f"{title}: {summary}", fontsize=11)
    return figure


def _draw_calibrated(panels: Iterable[tuple[Panel, int]], calibrated: Overlay, colour: str) -> None:
    """Draw the calibrated outlines over the panels."""
    colours = dict.fromkeys(OUTLINES, colour)
    for panel, phase in panels:
        Outlines(panel.image.axes, calibrated, panel.view, colours).show(phase)


def _endocardial_distance(registered: Overlay, calibrated: Overlay) -> str:
    """Return the distance between the left endocardia at the registered end systole as a sentence."""
    first, second = (overlay.motion.positions[registered.end_systole] for overlay in (registered, calibrated))
    distances, weights = surface_distances(first, second, registered.mesh.surfaces["lv_endo"])
    mean, most = 1e3 * (distances @ weights), 1e3 * distances.max()
    return f"distance of the left endocardia at end systole: mean {mean:.1f} mm, maximum {most:.1f} mm"
