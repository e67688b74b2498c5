"""The carried mesh over the images: at end diastole and end systole, and beating."""

from collections.abc import Iterable

import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.motion import Motion
from heartfit.imaging.sequence import ImageSequence
from heartfit.tables.overlay import OUTLINES, Overlay, Panel, draw_key, draw_phases

SIDES = {"lv": ("left ventricle", OUTLINES["lv_endo"][1]), "rv": ("right ventricle", OUTLINES["rv_endo"][1])}
DOTS_PER_INCH = 90


def plot_contours(sequence: ImageSequence, mesh: VentricularMesh, motion: Motion, title: str) -> Figure:
    """Contours at end diastole (phase 0) and at the least left volume, over a slice and two planes across all slices.

    mesh: at end diastole; motion: the same mesh in every phase, at the times of the frames. Raises InputError if the
    times are others.
    """
    figure = Figure(figsize=(10, 7), layout="constrained")
    draw_phases(figure, Overlay(sequence, mesh, motion))
    draw_key(figure, dict(OUTLINES.values()))
    figure.suptitle(title, fontsize=11)
    return figure


def animate_contours(
    sequence: ImageSequence, mesh: VentricularMesh, motion: Motion, title: str
) -> FuncAnimation:
    """The beating mesh over a slice and a plane across all slices, beside its volumes with a dot at the time shown.

    One picture for each frame of the images, as long as the beat; arguments as of plot_contours.
    """
    overlay = Overlay(sequence, mesh, motion)
    figure = Figure(figsize=(8, 3.2), dpi=DOTS_PER_INCH, layout="constrained")
    FigureCanvasAgg(figure)
    *left, right = figure.subplots(1, 3)
    panels = [Panel(axes, overlay, view) for axes, view in zip(left, overlay.views.values(), strict=False)]
    dots = _curves(right, overlay)
    draw_key(figure, dict(OUTLINES.values()))
    figure.suptitle(title, fontsize=10)
    figure.draw_without_rendering()
    figure.set_layout_engine("none")  # so that nothing moves but the heart

    def show(phase: int) -> Iterable[Artist]:
        for panel in panels:
            panel.show(phase)
        for side, dot in dots.items():
            dot.set_data([motion.times[phase]], [1e6 * overlay.volumes[side][phase]])
        return dots.values()

    count = len(motion.times)
    return FuncAnimation(figure, show, frames=count, interval=1e3 * motion.period / count)


def _curves(axes: Axes, overlay: Overlay) -> dict[str, Line2D]:
    """Draw the volumes over time; the dots on them, to be moved."""
    dots = {}
    for side, (label, colour) in SIDES.items():
        volumes = 1e6 * overlay.volumes[side]
        axes.plot(overlay.motion.times, volumes, color=colour, linewidth=1.4, label=label)
        (dots[side],) = axes.plot(overlay.motion.times[:1], volumes[:1], "o", color=colour, markersize=7)
    axes.set_ylim(0.0, 1.1e6 * max(np.max(volumes) for volumes in overlay.volumes.values()))
    axes.set_xlabel("time after trigger (s)")
    axes.set_ylabel("volume (mL)")
    axes.legend(frameon=False, fontsize=8, loc="lower right")
    axes.spines[["top", "right"]].set_visible(False)
    return dots
