"""Outlines over real short-axis images, registered and measured, and the volumes that follow from them."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from heartfit.geometry.arrays import Floats
from heartfit.imaging.sequence import ImageSequence
from heartfit.observation.cine import CineComparison
from heartfit.observation.curve import Curve
from heartfit.observation.outlines import Outline
from heartfit.tables.cine_tables import MILLILITRE, SQUARE_CENTIMETRE
from heartfit.tables.figures import CALIBRATED, MEASURED, REFERENCE

REGISTERED, SURFACE = CALIBRATED, "#56B4E9"
CAVITIES = {"lv_endo": ("-", "full", "left"), "rv_endo": ("--", "none", "right")}
MARGIN = 12
BRIGHTEST = 99.5
"""Pixels about the outlines, and the percentile of brightness that is white."""

LINES: dict[str, dict[str, Any]] = {
    "surface": {"color": MEASURED, "marker": "o", "markersize": 3.5, "linestyle": "none"},
    "cut": {"color": SURFACE, "linewidth": 1.4},
    "registered": {"color": REGISTERED, "linewidth": 1.8},
    "registered, ends at rest": {"color": REFERENCE, "linestyle": "--", "linewidth": 1.4},
}
LABELS = {
    "surface": "measured surface",
    "cut": "Simpson, surface cut by the slices",
    "registered": "Simpson, registered outlines",
    "registered, ends at rest": "the same, apex and base as at end diastole",
}


def plot_outlines(images: ImageSequence, cine: CineComparison, title: str) -> Figure:
    """A row for each slice in which the left ventricle is whole at end diastole, the last slice on top.

    Over the images at end diastole, at end systole and midway from there to the next beat: the measured surface's cut
    and what registration made of the cut at end diastole; then the areas of both cavities over the beat.
    """
    slices = [wall.slice for wall in cine.walls][::-1]
    frames = (0, cine.end_systole, (cine.end_systole + len(images.times)) // 2)
    figure = Figure(figsize=(11, 2.3 * len(slices)), layout="constrained")
    panels = figure.subplots(len(slices), 4, squeeze=False, width_ratios=(1, 1, 1, 1.3))
    box = _box(images, cine.outlines)
    for row, k in zip(panels, slices, strict=True):
        here = [outline for outline in cine.outlines if outline.slice == k]
        for axes, frame in zip(row, frames, strict=False):
            _image(axes, images, k, frame, box)
            for outline in here:
                _draw(axes, images, outline.measured[frame], SURFACE)
                _draw(axes, images, outline.carried[frame], REGISTERED)
        row[0].set_ylabel(f"slice {k}")
        _areas(row[3], images.times, here)
    for axes, name, frame in zip(
        panels[0], ("end diastole", "end systole", "mid-diastole"), frames, strict=False
    ):
        axes.set_title(f"{name}, {1e3 * images.times[frame]:.0f} ms", fontsize=9)
    panels[0, 3].set_title("area of the cavities (cm$^2$)", fontsize=9)
    panels[0, 3].legend(frameon=False, fontsize=8, loc="lower right")
    panels[-1, 3].set_xlabel("time after trigger (s)")
    figure.suptitle(f"{title}: registered (orange) and measured surface (blue, points)", fontsize=11)
    return figure


def plot_volumes(volumes: Mapping[str, Curve], title: str) -> Figure:
    """The left ventricle's volume, each way to it, over the beat."""
    figure = Figure(figsize=(6.5, 4), layout="constrained")
    axes = figure.subplots()
    for name, curve in volumes.items():
        axes.plot(curve.times, curve.values / MILLILITRE, label=LABELS[name], **LINES[name])
    axes.set_xlabel("time after trigger (s)")
    axes.set_ylabel("left ventricular volume (mL)")
    axes.set_ylim(bottom=0.0)
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, fontsize=8)
    axes.set_title(title, fontsize=11)
    return figure


def _box(images: ImageSequence, found: Sequence[Outline]) -> tuple[Floats, Floats]:
    """Lower and upper i, j of all outlines at end diastole, and a margin."""
    places = np.concatenate([outline.carried[0].reshape(-1, 3) for outline in found])
    index = images.grid.index(places)[:, :2]
    return index.min(axis=0) - MARGIN, index.max(axis=0) + MARGIN


def _image(axes: Axes, images: ImageSequence, k: int, frame: int, box: tuple[Floats, Floats]) -> None:
    white = np.percentile(images.voxels[:, k], BRIGHTEST)
    axes.imshow(images.voxels[frame, k], cmap="gray", vmin=0.0, vmax=white)
    (left, top), (right, bottom) = box
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_xticks([])
    axes.set_yticks([])


def _draw(axes: Axes, images: ImageSequence, segments: Floats, colour: str) -> None:
    lines = list(images.grid.index(segments)[..., :2])
    axes.add_collection(LineCollection(lines, colors=colour, linewidths=1.0))


def _areas(axes: Axes, times: Floats, here: Sequence[Outline]) -> None:
    for outline in here:
        if outline.surface in CAVITIES:
            line, fill, name = CAVITIES[outline.surface]
            axes.plot(times, outline.carried_area / SQUARE_CENTIMETRE, line, color=REGISTERED, label=name)
            measured = outline.measured_area / SQUARE_CENTIMETRE
            axes.plot(times, measured, "o", color=SURFACE, fillstyle=fill, markersize=3.5)
    axes.set_ylim(bottom=0.0)
    axes.spines[["top", "right"]].set_visible(False)
