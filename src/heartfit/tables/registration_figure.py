"""Fig. 6 of the paper, and further: volume of the simulation and after images and registration, and what that costs."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.observation.comparison import Comparison
from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures
from heartfit.observation.strain import DIRECTIONS, SEGMENTS
from heartfit.tables.acquisitions import Acquisitions, percent_errors, strain_errors
from heartfit.tables.figures import CALIBRATED, MEASURED, clean, colour
from heartfit.tables.registration_table import SLOPE_ERROR
from heartfit.tables.text import symbol

TRUE = {"color": MEASURED, "linewidth": 1.0}
REGISTERED = {"color": CALIBRATED, "linewidth": 1.0, "linestyle": "--"}
LARGEST_APART = 0.5
"""Offset between the directions of one segment, which stand side by side."""


def plot_registration(acquisitions: Acquisitions, operator: CurveFeatures, shown: int = 3) -> Figure:
    """Curves of the first ``shown`` sequences of the baseline, strain errors of all, errors over each varied setting.

    operator: takes the rates of volume, as it does for the observations.
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
    for each in axes:
        each.set_xlabel("time after trigger (s)")
        clean(each)


def _plot(axes: Axes, curve: Curve, label: str, style: dict[str, Any]) -> None:
    axes.plot(curve.times, 1e6 * curve.values, label=label or "_", **style)


def _strains(axes: Axes, comparisons: Sequence[Comparison]) -> None:
    """Mean and standard deviation over the sequences, direction by direction."""
    errors = strain_errors(comparisons)
    for index, direction in enumerate(DIRECTIONS):
        offset = LARGEST_APART * (index / (len(DIRECTIONS) - 1) - 0.5)
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
    """Mean of the unsigned errors over the value of a setting, with every sequence as a point."""
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
