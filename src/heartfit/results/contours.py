"""Contours of the mesh over the images of a patient, with the letters of the patient's sides."""

from collections.abc import Iterable

import numpy as np
from matplotlib.animation import FuncAnimation
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from heartfit.core.arrays import Floats
from heartfit.core.layout import lay_out
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.imaging.sampling import View
from heartfit.imaging.sequence import ImageSequence
from heartfit.results.figures import clean
from heartfit.results.overlay import OUTLINES, PIXEL, WHITE_PERCENTILE, Overlay, Panel, draw_key, draw_phases

TOWARDS = (("R", "L"), ("A", "P"), ("F", "H"))
"""Right and left, anterior and posterior, foot and head, along the axes of the scanner."""


def draw_view(axes: Axes, images: ImageSequence, view: View, frame: int) -> None:
    """Draw the images in a view [mm from its origin] with the letters of the sides of the patient."""
    left, bottom, right, top = 1e3 * np.array([*view.low, *view.high])
    bright = np.percentile(view.picture(images.voxels[0], images.grid, PIXEL), WHITE_PERCENTILE)
    picture = view.picture(images.voxels[frame], images.grid, PIXEL)
    axes.imshow(
        picture, cmap="gray", origin="lower", extent=(left, right, bottom, top), vmin=0.0, vmax=float(bright)
    )
    places = {(1.0, 0.5): view.right, (0.0, 0.5): -view.right, (0.5, 1.0): view.up, (0.5, 0.0): -view.up}
    for (x, y), direction in places.items():
        axes.text(
            0.03 + 0.94 * x,
            0.03 + 0.94 * y,
            side_letters(direction),
            color="white",
            fontsize=9,
            fontweight="bold",
            ha="center",
            va="center",
            transform=axes.transAxes,
        )
    axes.set_axis_off()


def side_letters(direction: Floats) -> str:
    """Return the sides of the patient in a direction (3,), the nearest first: "AL" is anterior and left."""
    near = [axis for axis in np.argsort(-np.abs(direction)) if abs(direction[axis]) > 0.4]
    return "".join(TOWARDS[axis][int(direction[axis] > 0.0)] for axis in near)


SIDES = {"lv": ("left ventricle", OUTLINES["lv_endo"][1]), "rv": ("right ventricle", OUTLINES["rv_endo"][1])}
DOTS_PER_INCH = 90


def plot_contours(sequence: ImageSequence, mesh: VentricularMesh, motion: Motion, title: str) -> Figure:
    """Plot contours at end diastole and at the least left volume, over a slice and two planes across the slices.

    mesh: at end diastole; motion: the same mesh in each phase, at the times of the frames. Raises InputError for other
    times.
    """
    figure = Figure(figsize=(10, 7), layout="constrained")
    draw_phases(figure, Overlay(sequence, mesh, motion))
    draw_key(figure, dict(OUTLINES.values()))
    figure.suptitle(title, fontsize=11)
    return figure


def animate_contours(
    sequence: ImageSequence, mesh: VentricularMesh, motion: Motion, title: str
) -> FuncAnimation:
    """Animate the mesh over a slice and a plane across the slices, with its volumes with moving dots.

    One picture per frame of the images, with the duration of the beat; arguments as of plot_contours.
    """
    overlay = Overlay(sequence, mesh, motion)
    figure = Figure(figsize=(8, 3.2), dpi=DOTS_PER_INCH, layout="constrained")
    FigureCanvasAgg(figure)
    *left, right = figure.subplots(1, 3)
    panels = [Panel(axes, overlay, view) for axes, view in zip(left, overlay.views.values(), strict=False)]
    dots = _curves(right, overlay)
    draw_key(figure, dict(OUTLINES.values()))
    figure.suptitle(title, fontsize=10)
    lay_out(figure)

    def show(phase: int) -> Iterable[Artist]:
        for panel in panels:
            panel.show(phase)
        for side, dot in dots.items():
            dot.set_data([motion.times[phase]], [1e6 * overlay.volumes[side][phase]])
        return dots.values()

    count = len(motion.times)
    return FuncAnimation(figure, show, frames=count, interval=1e3 * motion.period / count)


def _curves(axes: Axes, overlay: Overlay) -> dict[str, Line2D]:
    """Draw the volumes over time, and return the dots on them by side."""
    dots = {}
    for side, (label, colour) in SIDES.items():
        volumes = 1e6 * overlay.volumes[side]
        axes.plot(overlay.motion.times, volumes, color=colour, linewidth=1.4, label=label)
        (dots[side],) = axes.plot(overlay.motion.times[:1], volumes[:1], "o", color=colour, markersize=7)
    axes.set_ylim(0.0, 1.1e6 * max(np.max(volumes) for volumes in overlay.volumes.values()))
    axes.set_xlabel("time after trigger (s)")
    axes.set_ylabel("volume (mL)")
    axes.legend(frameon=False, fontsize=8, loc="lower right")
    clean(axes)
    return dots
