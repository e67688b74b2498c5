"""Registration errors on a real cine that moves as simulated: the paper's section 4.3 as table and figure."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.sections import cut_surface
from heartfit.imaging.sequence import ImageSequence
from heartfit.observation.comparison import Comparison
from heartfit.observation.operator import CurveFeatures
from heartfit.observation.outlines import slice_plane
from heartfit.results.errors import PAPER, root_mean_square
from heartfit.results.figures import CALIBRATED, MEASURED, clean, colour
from heartfit.results.registration import SLOPE_ERROR

CONTENTS = {
    "first": "real cine, first frame warped",
    "every": "real cine, every frame warped",
    "phantom": "phantom in the same slices",
}
"""Rows by content of the images, see heartfit.synthetic.warp."""
TRUE_OUTLINE, REGISTERED_OUTLINE = "#56B4E9", CALIBRATED
MARGIN = 12e-3
"""Width of the surroundings of the heart in a panel [m]."""
WHITE_PERCENTILE = 99.5


def warped_table(comparisons: Mapping[str, Comparison]) -> pd.DataFrame:
    """Return one row per content of the images, then the paper's.

    Signed errors of the observations [%], registered over true; root mean square errors of both volumes over the beat
    [mL]; distances of the nodes, mean and 95th percentile over the beat, and mean at end systole [mm]; circumferential
    and longitudinal strain at end systole, root mean square over the segments [% strain].
    """
    rows = [_row(CONTENTS[content], comparison) for content, comparison in comparisons.items()]
    paper = {
        "images": PAPER,
        "q_max (%)": f"{SLOPE_ERROR:.0f}, unsigned",
        "q_min (%)": f"{SLOPE_ERROR:.0f}, unsigned",
    }
    return pd.DataFrame([*rows, paper])


def _row(label: str, comparison: Comparison) -> dict[str, Any]:
    true, registered = comparison.pair.true.curves, comparison.pair.measured.curves
    errors = {
        f"{name} (%)": 100.0 * error
        for name, error in comparison.observation_errors().items()
        if name in ("V_min", "q_max", "q_min")
    }
    volumes = {
        f"{side.upper()} RMS (mL)": 1e6
        * float(root_mean_square(registered[f"{side}_volume"].values - true[f"{side}_volume"].values))
        for side in ("lv", "rv")
    }
    mean, far = 1e3 * comparison.point_error_of_beat
    strain = 100.0 * root_mean_square(comparison.strain_error_at_end_systole(), axis=1)
    return {
        "images": label,
        **errors,
        **volumes,
        "points (mm)": mean,
        "points 95 % (mm)": far,
        "ES points (mm)": 1e3 * comparison.point_error[comparison.end_systole, 0],
        "circumferential strain (%)": strain[0],
        "longitudinal strain (%)": strain[1],
    }


def plot_warped(
    images: Mapping[str, ImageSequence],
    mesh: VentricularMesh,
    motions: Mapping[str, Floats],
    comparisons: Mapping[str, Comparison],
    operator: CurveFeatures,
) -> Figure:
    """Plot end systole in each real-cine sequence with true and registered outlines, and the volume curves.

    images: of the real contents, on one grid; motions: positions (p, n, 3) [m] of the nodes, "true" and by content.
    """
    first = next(iter(images.values()))
    slices = range(1, first.grid.size[2] - 1)
    figure = Figure(figsize=(2.6 * len(slices), 2.6 * len(images) + 3.4), layout="constrained")
    parts = figure.subfigures(2, 1, height_ratios=(2.6 * len(images), 3.4), squeeze=False)
    upper, lower = parts[:, 0]
    panels = upper.subplots(len(images), len(slices), squeeze=False)
    for row, (content, sequence) in zip(panels, images.items(), strict=True):
        frame = comparisons[content].end_systole
        for axes, k in zip(row, slices, strict=True):
            _section(axes, sequence, frame, k, mesh, (motions["true"], motions[content]))
        row[0].set_ylabel(CONTENTS[content], fontsize=8)
    for axes, k in zip(panels[0], slices, strict=True):
        axes.set_title(f"slice {k}, end systole", fontsize=8)
    _curves(lower.subplots(1, 2), comparisons, operator)
    return figure


def _section(
    axes: Axes, sequence: ImageSequence, frame: int, k: int, mesh: VentricularMesh, motions: Sequence[Floats]
) -> None:
    grid, image = sequence.grid, sequence.voxels[frame, k]
    axes.imshow(
        image, cmap="gray", vmin=0.0, vmax=float(np.percentile(sequence.voxels[:, k], WHITE_PERCENTILE))
    )
    origin, normal = slice_plane(grid, k)
    for positions, colour_of, width in zip(
        motions, (TRUE_OUTLINE, REGISTERED_OUTLINE), (1.6, 0.9), strict=True
    ):
        for name in ("lv_endo", "rv_endo", "epi"):
            segments = cut_surface(positions[frame], mesh.surfaces[name], origin, normal)
            lines = grid.index(segments.reshape(-1, 3)).reshape(-1, 2, 3)[..., :2]
            axes.add_collection(LineCollection(list(lines), colors=colour_of, linewidths=width))
    places = grid.index(mesh.points)[:, :2]
    margin = MARGIN / grid.spacing[0]
    low, high = places.min(axis=0) - margin, places.max(axis=0) + margin
    axes.set(xlim=(low[0], high[0]), ylim=(high[1], low[1]), xticks=[], yticks=[])


def _curves(panels: Sequence[Axes], comparisons: Mapping[str, Comparison], operator: CurveFeatures) -> None:
    volumes, rates = panels
    readings = {"simulated": next(iter(comparisons.values())).pair.true}
    readings |= {CONTENTS[content]: comparison.pair.measured for content, comparison in comparisons.items()}
    for index, (label, reading) in enumerate(readings.items()):
        curve = reading.curves["lv_volume"]
        shade, width = (MEASURED, 2.0) if index == 0 else (colour(index - 1), 1.2)
        volumes.plot(curve.times, 1e6 * curve.values, label=label, color=shade, linewidth=width)
        rate = operator.rate(curve)
        rates.plot(rate.times, 1e6 * rate.values, color=shade, linewidth=width)
    volumes.set_ylabel("LV volume (mL)")
    volumes.legend(frameon=False, fontsize=8)
    rates.set_ylabel("dV/dt (mL/s)")
    rates.axhline(0.0, color="black", linewidth=0.6)
    for panel in (volumes, rates):
        panel.set_xlabel("time after trigger (s)")
        clean(panel)
