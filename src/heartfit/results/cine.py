"""Registration of real short-axis images, compared with the measured surface cut by the same planes."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.imaging.sequence import ImageSequence
from heartfit.observation.cine import CineComparison
from heartfit.observation.curve import Curve
from heartfit.observation.operator import VolumeFeatures
from heartfit.observation.outlines import Outline, WallPoints
from heartfit.results.errors import root_mean_square
from heartfit.results.figures import CALIBRATED, MEASURED, REFERENCE, clean

SURFACE_NAMES = {"lv_endo": "LV endocardium", "rv_endo": "RV endocardium", "epi": "epicardium"}
SQUARE_CENTIMETRE, MILLIMETRE, MILLILITRE = 1e-4, 1e-3, 1e-6


def cine_tables(cine: CineComparison, case: str) -> dict[str, pd.DataFrame]:
    """Return the tables of the outlines, of points of the wall and of volumes, by name."""
    return {
        f"{case}_cine_outlines": outline_table(cine),
        f"{case}_cine_wall": wall_table(cine),
        f"{case}_cine_volume": short_axis_volume_table(cine.volumes),
    }


def cine_figures(images: ImageSequence, cine: CineComparison, case: str) -> dict[str, Figure]:
    """Plot the outlines over the images, and the volumes, by name."""
    return {
        f"{case}_cine_outlines": plot_outlines(images, cine, case),
        f"{case}_cine_volume": plot_volumes(cine.volumes, case),
    }


def outline_table(cine: CineComparison) -> pd.DataFrame:
    """Return one row per outline and slice with a closed measured outline; slices above the valves have none.

    Areas are measured areas. Their errors, registered less measured, are percent of the area at end diastole, because
    an apex can leave its slice. Distances are means along both outlines, averaged over the frames after the first, as
    is the 95th percentile of each frame; "unmoved" is the distance of the outline of end diastole itself.
    """
    return pd.DataFrame([_outline_row(outline, cine.end_systole) for outline in cine.outlines])


def _outline_row(outline: Outline, end_systole: int) -> dict[str, object]:
    later = outline.frames[outline.frames > 0]
    area = outline.measured_area
    error = 100.0 * (outline.carried_area - area) / area[0]
    mean, far = (distance / MILLIMETRE for distance in outline.distance())
    return {
        "outline": SURFACE_NAMES[outline.surface],
        "slice": outline.slice,
        "frames": len(later),
        "ED (cm^2)": area[0] / SQUARE_CENTIMETRE,
        "ES (cm^2)": area[end_systole] / SQUARE_CENTIMETRE,
        "error ES (% of ED)": error[end_systole],
        "error RMS (% of ED)": float(root_mean_square(error[later])),
        "distance ES (mm)": mean[end_systole],
        "distance (mm)": float(mean[later].mean()),
        "distance 95 % (mm)": float(far[later].mean()),
        "unmoved (mm)": float(outline.distance_at_rest()[later].mean() / MILLIMETRE),
    }


def wall_table(cine: CineComparison) -> pd.DataFrame:
    """Return one row per slice: distance of points followed in the plane from those of the measured surface [mm].

    In the plane: mean over the points at end systole, over points and frames after the first, and the 95th percentile;
    outwards: signed component across the wall. Motion of the measured points in the plane, and through it towards
    higher slices, which registration in the plane cannot follow.
    """
    return pd.DataFrame([_wall_row(wall, cine.end_systole) for wall in cine.walls])


def _wall_row(wall: WallPoints, end_systole: int) -> dict[str, object]:
    distances = wall.in_plane()[1:] / MILLIMETRE
    through = wall.through_plane()[end_systole] / MILLIMETRE
    path = np.linalg.norm((wall.measured[end_systole] - wall.measured[0]) / MILLIMETRE, axis=1)
    return {
        "slice": wall.slice,
        "points": distances.shape[1],
        "ES (mm)": float(distances[end_systole - 1].mean()),
        "beat (mm)": float(distances.mean()),
        "95 % (mm)": float(np.quantile(distances, 0.95)),
        "outwards ES (mm)": float(wall.across()[end_systole].mean() / MILLIMETRE),
        "motion in plane ES (mm)": float(np.sqrt(np.maximum(path**2 - through**2, 0.0)).mean()),
        "motion through plane ES (mm)": float(through.mean()),
    }


def short_axis_volume_table(volumes: Mapping[str, Curve]) -> pd.DataFrame:
    """Return one row per method for the volume of the left ventricle, see heartfit.observation.cine.

    Largest and smallest volume, ejection fraction, the rates that the calibration observes, and the root mean square
    difference from the volume of the surface over the beat.
    """
    return pd.DataFrame([_volume_row(name, curve, volumes["surface"]) for name, curve in volumes.items()])


def _volume_row(name: str, curve: Curve, surface: Curve) -> dict[str, object]:
    largest, smallest = curve.values.max() / MILLILITRE, curve.values.min() / MILLILITRE
    rates = VolumeFeatures()(curve)
    return {
        "volume": name,
        "EDV (mL)": largest,
        "ESV (mL)": smallest,
        "EF (%)": 100.0 * (1.0 - smallest / largest),
        "q_max (mL/s)": rates["q_max"] / MILLILITRE,
        "q_min (mL/s)": rates["q_min"] / MILLILITRE,
        "RMS (mL)": float(root_mean_square(curve.values - surface.values) / MILLILITRE),
    }


REGISTERED, SURFACE = CALIBRATED, "#56B4E9"
CAVITIES = {"lv_endo": ("-", "full", "left"), "rv_endo": ("--", "none", "right")}
MARGIN = 12
WHITE_PERCENTILE = 99.5
"""Margin around the outlines [pixels], and percentile of the brightness in this box that is white."""

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
    "registered, ends at rest": "Simpson, registered outlines, apex and base fixed",
}


def plot_outlines(images: ImageSequence, cine: CineComparison, title: str) -> Figure:
    """Plot one row per slice that contains the whole left ventricle at end diastole, the last slice on top.

    Images at end diastole, at end systole and midway from there to the next beat, with the cut of the measured surface
    and the registered outline; then the areas of both cavities over the beat.
    """
    slices = [wall.slice for wall in cine.walls][::-1]
    frames = (0, cine.end_systole, (cine.end_systole + len(images.times)) // 2)
    figure = Figure(figsize=(11, 2.3 * len(slices)), layout="constrained")
    panels = figure.subplots(len(slices), 4, squeeze=False, width_ratios=(1, 1, 1, 1.3))
    box = _bounding_box(images, cine.outlines)
    for row, k in zip(panels, slices, strict=True):
        outlines = [outline for outline in cine.outlines if outline.slice == k]
        for axes, frame in zip(row, frames, strict=False):
            _image(axes, images, k, frame, box)
            for outline in outlines:
                _draw(axes, images, outline.measured[frame], SURFACE)
                _draw(axes, images, outline.carried[frame], REGISTERED)
        row[0].set_ylabel(f"slice {k}")
        _areas(row[3], images.times, outlines)
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
    """Plot the volume of the left ventricle over the beat by each method."""
    figure = Figure(figsize=(6.5, 4), layout="constrained")
    axes = figure.subplots()
    for name, curve in volumes.items():
        axes.plot(curve.times, curve.values / MILLILITRE, label=LABELS[name], **LINES[name])
    axes.set_xlabel("time after trigger (s)")
    axes.set_ylabel("left ventricular volume (mL)")
    axes.set_ylim(bottom=0.0)
    clean(axes)
    axes.legend(frameon=False, fontsize=8)
    axes.set_title(title, fontsize=11)
    return figure


def _bounding_box(images: ImageSequence, outlines: Sequence[Outline]) -> tuple[Floats, Floats]:
    """Return the lower and upper (i, j) of all outlines at end diastole with a margin."""
    places = np.concatenate([outline.carried[0].reshape(-1, 3) for outline in outlines])
    index = images.grid.index(places)[:, :2]
    return index.min(axis=0) - MARGIN, index.max(axis=0) + MARGIN


def _image(axes: Axes, images: ImageSequence, k: int, frame: int, box: tuple[Floats, Floats]) -> None:
    (left, top), (right, bottom) = box
    first, last = np.maximum(np.rint(box[0]).astype(int), 0), np.rint(box[1]).astype(int) + 1
    shown = images.voxels[:, k, first[1] : last[1], first[0] : last[0]]
    axes.imshow(
        images.voxels[frame, k], cmap="gray", vmin=0.0, vmax=float(np.percentile(shown, WHITE_PERCENTILE))
    )
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_xticks([])
    axes.set_yticks([])


def _draw(axes: Axes, images: ImageSequence, segments: Floats, colour: str) -> None:
    lines = list(images.grid.index(segments)[..., :2])
    axes.add_collection(LineCollection(lines, colors=colour, linewidths=1.0))


def _areas(axes: Axes, times: Floats, outlines: Sequence[Outline]) -> None:
    for outline in outlines:
        if outline.surface in CAVITIES:
            line, fill, name = CAVITIES[outline.surface]
            axes.plot(times, outline.carried_area / SQUARE_CENTIMETRE, line, color=REGISTERED, label=name)
            measured = outline.measured_area / SQUARE_CENTIMETRE
            axes.plot(times, measured, "o", color=SURFACE, fillstyle=fill, markersize=3.5)
    axes.set_ylim(bottom=0.0)
    clean(axes)
