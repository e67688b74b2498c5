"""Registration errors as tables and a figure: section 4.3 of the paper, by acquisition and by segment.

References
----------
Marchesseau et al. 2012, section 4.3: about 25 % on both slopes. Tobon-Gomez C et al. 2013,
doi 10.1016/j.media.2013.03.008: errors of tracked landmarks in volunteers.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.observation.comparison import Comparison
from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures
from heartfit.observation.strain import DIRECTIONS, SEGMENTS
from heartfit.results.acquisitions import Acquisitions, percent_errors, strain_errors
from heartfit.results.errors import PAPER, root_mean_square
from heartfit.results.figures import CALIBRATED, MEASURED, clean, colour
from heartfit.results.text import symbol

SLOPE_ERROR = 25.0
"""Error of both slopes in the paper [%]."""
TRACKING_ERROR = "1.5 to 2.1"
"""Landmark errors of published methods [mm]."""
NO_COUNTS = {"sequences": "", "folded": ""}
TOBON_GOMEZ = "Tobon-Gomez et al. 2013"


def registration_table(acquisitions: Acquisitions) -> pd.DataFrame:
    """Return one row per protocol, then the published errors.

    Observations: mean over the sequences of the unsigned error and of the signed error ("bias", negative for a size
    that is underestimated) [%]. Strains at end systole: root mean square over sequences and segments [% strain].
    Points: mean, and mean of the 95th percentiles of the sequences, over the beat and at end systole [mm]. Folded:
    largest number of folded tetrahedra in a frame.
    """
    rows = [_protocol_row(label, comparisons) for label, comparisons in acquisitions.rows().items()]
    paper = {"acquisition": PAPER, **NO_COUNTS, "q_max (%)": SLOPE_ERROR, "q_min (%)": SLOPE_ERROR}
    tracked = {"acquisition": TOBON_GOMEZ, **NO_COUNTS, "points (mm)": TRACKING_ERROR}
    return pd.DataFrame([*rows, paper, tracked])


def segment_table(comparisons: Sequence[Comparison]) -> pd.DataFrame:
    """Return one row per AHA segment: mean true strain over the sequences, bias and error of the registered strain.

    All at end systole in percent strain; "bias" is the mean of registered less true strain, "RMS" its root mean square.
    """
    true = 100.0 * np.array([comparison.true_strain[comparison.end_systole] for comparison in comparisons])
    error = strain_errors(comparisons)
    table: dict[str, Any] = {"segment": SEGMENTS}
    for index, direction in enumerate(DIRECTIONS):
        table[f"{direction} (%)"] = true[:, index].mean(axis=0)
        table[f"{direction} bias (%)"] = error[:, index].mean(axis=0)
        table[f"{direction} RMS (%)"] = root_mean_square(error[:, index], axis=0)
    return pd.DataFrame(table)


def _protocol_row(label: str, comparisons: Sequence[Comparison]) -> dict[str, Any]:
    row: dict[str, Any] = {"acquisition": label, "sequences": len(comparisons)}
    for name, errors in percent_errors(comparisons).items():
        row |= {f"{name} (%)": np.abs(errors).mean(), f"{name} bias (%)": errors.mean()}
    strain = strain_errors(comparisons)
    row |= {
        f"{direction} (%)": float(root_mean_square(strain[:, index]))
        for index, direction in enumerate(DIRECTIONS)
    }
    beat = 1e3 * np.mean([comparison.point_error_of_beat for comparison in comparisons], axis=0)
    systole = 1e3 * np.mean(
        [comparison.point_error[comparison.end_systole] for comparison in comparisons], axis=0
    )
    row |= {"points (mm)": beat[0], "points 95th (mm)": beat[1]}
    row |= {"ES points (mm)": systole[0], "ES points 95th (mm)": systole[1]}
    return row | {"folded": max(int(comparison.folded.max()) for comparison in comparisons)}


TRUE = {"color": MEASURED, "linewidth": 1.0}
REGISTERED = {"color": CALIBRATED, "linewidth": 1.0, "linestyle": "--"}
DIRECTION_SPREAD = 0.5
"""Distance between the outer directions of one segment, in segments."""


def plot_registration(acquisitions: Acquisitions, operator: CurveFeatures, shown: int = 3) -> Figure:
    """Plot curves of the first ``shown`` baseline sequences, strain errors of all, and errors over each varied setting.

    operator: takes the rates of volume, as for the observations.
    """
    figure = Figure(figsize=(13, 7), layout="constrained")
    upper, lower = figure.subfigures(2, 1, squeeze=False).ravel()
    left, middle, right = upper.subplots(1, 3)
    _curves((left, middle), acquisitions.baseline[:shown], operator)
    _strains(right, acquisitions.baseline)
    panels = np.atleast_1d(lower.subplots(1, max(1, len(acquisitions.varied)), sharey=True))
    for axes, heading in zip(panels, acquisitions.varied, strict=False):
        _errors(axes, acquisitions, heading)
    panels[0].set_ylabel("unsigned error (%)")
    panels[0].legend(frameon=False, fontsize=8)
    return figure


def _curves(axes: tuple[Axes, Axes], comparisons: Sequence[Comparison], operator: CurveFeatures) -> None:
    volumes, rates = axes
    for comparison in comparisons:
        for label, style, reading in (
            ("simulated", TRUE, comparison.pair.true),
            ("after registration", REGISTERED, comparison.pair.measured),
        ):
            volume = reading.curves["lv_volume"]
            _plot(volumes, volume, label if comparison is comparisons[0] else "", style)
            _plot(rates, operator.rate(volume), "", style)
    volumes.set_ylabel("LV volume (mL)")
    volumes.legend(frameon=False, fontsize=8)
    rates.set_ylabel("dV/dt (mL/s)")
    rates.axhline(0.0, color="black", linewidth=0.6)
    for panel in axes:
        panel.set_xlabel("time after trigger (s)")
        clean(panel)


def _plot(axes: Axes, curve: Curve, label: str, style: dict[str, Any]) -> None:
    axes.plot(curve.times, 1e6 * curve.values, label=label or "_", **style)


def _strains(axes: Axes, comparisons: Sequence[Comparison]) -> None:
    """Plot the mean and standard deviation over the sequences for each direction."""
    errors = strain_errors(comparisons)
    for index, direction in enumerate(DIRECTIONS):
        offset = DIRECTION_SPREAD * (index / (len(DIRECTIONS) - 1) - 0.5)
        mean, sd = errors[:, index].mean(axis=0), errors[:, index].std(axis=0)
        axes.errorbar(
            SEGMENTS + offset,
            mean,
            sd,
            fmt="o",
            markersize=3.5,
            linewidth=0.9,
            color=colour(index),
            label=direction,
        )
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.set_xticks(SEGMENTS, [str(segment) for segment in SEGMENTS], fontsize=7)
    axes.set_xlabel("AHA segment")
    axes.set_ylabel("error of strain at end systole (% strain)")
    axes.legend(frameon=False, fontsize=8)
    clean(axes)


def _errors(axes: Axes, acquisitions: Acquisitions, heading: str) -> None:
    """Plot the mean of the unsigned errors over the value of a setting, and each sequence as a point."""
    course = {value: percent_errors(group) for value, group in acquisitions.course(heading).items()}
    for index, name in enumerate(next(iter(course.values()))):
        unsigned = [np.abs(errors[name]) for errors in course.values()]
        means = [errors.mean() for errors in unsigned]
        axes.plot(
            list(course), means, "o-", markersize=4, linewidth=1.4, color=colour(index), label=symbol(name)
        )
        for value, errors in zip(course, unsigned, strict=True):
            axes.plot(
                np.full(len(errors), value),
                errors,
                "o",
                markersize=2,
                alpha=0.35,
                color=colour(index),
                zorder=1,
            )
    axes.axhline(SLOPE_ERROR, color="black", linewidth=1.0, linestyle=":", label="paper, both slopes")
    axes.axvline(acquisitions.settings[heading], color="0.85", linewidth=4.0, zorder=0, label="baseline")
    axes.set_xlabel(heading)
    axes.set_xticks(list(course))
    axes.set_ylim(bottom=0.0)
    clean(axes)
