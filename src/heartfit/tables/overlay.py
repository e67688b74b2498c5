"""A moving mesh drawn over images, phase for phase."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import FigureBase
from matplotlib.image import AxesImage
from matplotlib.lines import Line2D

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.imaging.sequence import ImageSequence
from heartfit.imaging.view import View, views
from heartfit.observation.volumes import cavity_volumes

OUTLINES = {"lv_endo": ("left endocardium", "#D55E00"), "rv_endo": ("right endocardium", "#56B4E9")}
OUTLINES |= {"epi": ("epicardium", "#F0E442")}
COLOURS = {name: colour for name, (_, colour) in OUTLINES.items()}
PIXEL = 0.7e-3
"""Width of a pixel of the pictures, m."""

WHITE = 99.5
"""Percentile of the brightness at end diastole, in the view, that is drawn white."""

SAME_TIME = 1e-3
"""Difference of a phase from its frame that is rounding, over the period."""


@dataclass(frozen=True, eq=False)
class Overlay:
    """Images and the motion of a mesh, phase for phase; raises InputError if they are not of the same times."""

    sequence: ImageSequence
    mesh: VentricularMesh
    motion: Motion

    def __post_init__(self) -> None:
        frames, phases = self.sequence.times, self.motion.times
        if frames.shape != phases.shape or np.abs(frames - phases).max() > SAME_TIME * self.motion.period:
            raise InputError(
                f"overlay: {len(phases)} phases of the motion, {len(frames)} frames of the images; expected the same "
                "times: take the images that the motion was registered from"
            )

    @cached_property
    def volumes(self) -> Mapping[str, Floats]:
        """Volume (p,) in m^3 of the left and right cavity, by "lv" and "rv"."""
        curves = cavity_volumes(self.mesh, self.motion)
        return {side: curves[f"{side}_volume"].values for side in ("lv", "rv")}

    @property
    def end_systole(self) -> int:
        """The phase of the least left volume."""
        return int(self.volumes["lv"].argmin())

    @cached_property
    def views(self) -> Mapping[str, View]:
        """Planes through the left ventricle, by what they are."""
        return views(self.sequence.grid, self.mesh)


class Panel:
    """One view of an overlay, drawn into axes, in any phase."""

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
        self.image.set_clim(0.0, float(np.percentile(self._picture(0), WHITE)))
        self.outlines = Outlines(axes, overlay, view, colours)
        axes.set_axis_off()

    def show(self, phase: int) -> None:
        """The image and where the plane cuts the mesh in this phase, in mm from the view's origin."""
        self.image.set_data(self._picture(phase))
        self.outlines.show(phase)

    def _picture(self, phase: int) -> Floats:
        sequence = self.overlay.sequence
        return self.view.picture(sequence.voxels[phase], sequence.grid, PIXEL)


class Outlines:
    """Where a view cuts the surfaces of an overlay's mesh, drawn into axes, in any phase; colours by surface."""

    def __init__(self, axes: Axes, overlay: Overlay, view: View, colours: Mapping[str, str]) -> None:
        self.overlay, self.view = overlay, view
        self.lines = {
            name: LineCollection([], colors=colour, linewidths=1.2) for name, colour in colours.items()
        }
        for line in self.lines.values():
            axes.add_collection(line, autolim=False)

    def show(self, phase: int) -> None:
        """The outlines in this phase, in mm from the view's origin."""
        points = self.overlay.motion.positions[phase]
        for name, line in self.lines.items():
            line.set_segments(list(1e3 * self.view.outline(points, self.overlay.mesh.surfaces[name])))


def draw_phases(
    figure: FigureBase, overlay: Overlay, colours: Mapping[str, str] = COLOURS
) -> list[tuple[Panel, int]]:
    """Every view at end diastole (phase 0), and below at end systole, with the phase that each panel shows."""
    phases = {"end diastole": 0, "end systole": overlay.end_systole}
    shown = []
    for row, (name, phase) in zip(figure.subplots(2, len(overlay.views)), phases.items(), strict=True):
        for axes, (what, view) in zip(row, overlay.views.items(), strict=True):
            panel = Panel(axes, overlay, view, colours)
            panel.show(phase)
            axes.set_title(f"{name}, {1e3 * overlay.motion.times[phase]:.0f} ms: {what}", fontsize=9)
            shown.append((panel, phase))
    return shown


def draw_key(figure: FigureBase, colours: Mapping[str, str]) -> None:
    """The colours by what they mean, below all panels."""
    lines = [Line2D([], [], color=colour, label=label) for label, colour in colours.items()]
    figure.legend(handles=lines, loc="outside lower center", ncols=len(lines), frameon=False, fontsize=9)
