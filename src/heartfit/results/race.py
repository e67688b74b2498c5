"""Comparison of calibration methods and coverage of their intervals on spheres, as tables and figures."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.observation.noise_model import Share
from heartfit.results.figures import clean, colour
from heartfit.results.text import symbol
from heartfit.synthetic.race import Coverage, MethodScore

QUARTILES = (25.0, 50.0, 75.0)
ERRORS = {
    "observations": "error of the observations (%)",
    "parameters": "error of the parameters (prior sd)",
}
ERROR_UNITS = {"observations": "%", "parameters": "prior sd"}
PRIOR, PUBLISHED = "prior", "unscented, R = 0"
MARKERS = "osD^vP"
METHOD_OFFSET = 0.35
"""Horizontal distance between methods [simulations]."""


def race_table(scores: Mapping[str, Sequence[MethodScore]]) -> pd.DataFrame:
    """Return one row per group of hearts, method and number of simulations: median and quartiles over the hearts.

    "hearts": number of hearts that the method finished and whose estimate has a beat.
    """
    return pd.DataFrame([row for name, marks in scores.items() for row in _race_rows(name, marks)])


def _race_rows(name: str, marks: Sequence[MethodScore]) -> list[dict[str, Any]]:
    methods = list(dict.fromkeys(mark.method for mark in marks))
    ordered = sorted(marks, key=lambda mark: (methods.index(mark.method), mark.simulations))
    return [
        _race_row(name, method, simulations, [mark for mark in group if np.isfinite(mark.observations)])
        for (method, simulations), group in groupby(ordered, lambda mark: (mark.method, mark.simulations))
    ]


def _race_row(name: str, method: str, simulations: int, marks: Sequence[MethodScore]) -> dict[str, Any]:
    row: dict[str, Any] = {
        "measured": name,
        "method": method,
        "simulations": simulations,
        "hearts": len(marks),
    }
    for quantity in ERRORS:
        values = [getattr(mark, quantity) for mark in marks] or [np.nan]
        low, median, high = np.percentile(values, QUARTILES).tolist()
        unit = ERROR_UNITS[quantity]
        row |= {f"{quantity} ({unit})": median, f"{quantity}, lower": low, f"{quantity}, upper": high}
    return row


def plot_race(table: pd.DataFrame) -> Figure:
    """Plot errors of observations and parameters over the number of simulations, one row per group of hearts."""
    groups = list(table.groupby("measured", sort=False))
    figure = Figure(figsize=(10, 0.5 + 3.4 * len(groups)), layout="constrained")
    panels = figure.subplots(len(groups), 2, squeeze=False)
    for row, (name, rows) in zip(panels, groups, strict=True):
        for axes, quantity in zip(row, ERRORS, strict=True):
            _methods(axes, rows, quantity)
        row[0].set_title(f"measured: {name}", fontsize=10, loc="left")
    handles, labels = panels[0, 1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", frameon=False, fontsize=9, ncols=4)
    return figure


def _methods(axes: Axes, rows: pd.DataFrame, quantity: str) -> None:
    unit = ERROR_UNITS[quantity]
    middle = f"{quantity} ({unit})"
    prior = rows[rows["method"] == PRIOR]
    if len(prior):
        axes.axhline(prior[middle].iloc[0], color="0.6", linewidth=1.0, linestyle="--", label=PRIOR)
    methods = rows[rows["method"] != PRIOR].groupby("method", sort=False)
    for index, (method, group) in enumerate(methods):
        x = group["simulations"] + METHOD_OFFSET * (index - (len(methods) - 1) / 2)
        around = [group[middle] - group[f"{quantity}, lower"], group[f"{quantity}, upper"] - group[middle]]
        style = {"color": colour(index), "marker": MARKERS[index % len(MARKERS)], "label": method}
        axes.errorbar(x, group[middle], around, markersize=4.5, linewidth=1.3, elinewidth=0.7, **style)
    _ring(axes, rows[rows["method"] == PUBLISHED], middle, -METHOD_OFFSET * (len(methods) - 1) / 2)
    axes.set_xlabel("simulations of a heart")
    axes.set_ylabel(ERRORS[quantity])
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    clean(axes)


def _ring(axes: Axes, rows: pd.DataFrame, middle: str, offset: float) -> None:
    """Draw a ring around the single step of the paper."""
    if len(rows):
        first = rows.iloc[0]
        place = first["simulations"] + offset, first[middle]
        axes.plot(*place, "o", markersize=13, fillstyle="none", color="black", label="step of the paper")


POOLED = "all"
NOMINAL_COVERAGE = 95.0
SHOWN_WORLD = "parameters"
"""World of the panels that show a single world."""
LEAST_COVERAGE = 50.0
"""Lower limit of the axis of coverage [%]."""
SCORE_LIMIT = 4.0
"""Limit of the histogram of scores; the outermost bars contain scores beyond it."""


def sphere_coverage_table(coverages_by_group: Mapping[str, Sequence[Coverage]]) -> pd.DataFrame:
    """Return one row per group of hearts, world, noise and parameter: coverage with its exact interval.

    Errors of the estimates are in standard deviations of their posteriors, with mean 0 and deviation 1 for an exact
    posterior. A failed calibration counts as not covered. The row "all" pools the parameters; its trials are hearts.
    """
    return pd.DataFrame(
        [
            _coverage_row(name, coverage, parameter, share)
            for name, coverages in coverages_by_group.items()
            for coverage in coverages
            for parameter, share in {POOLED: coverage.pooled(), **coverage.shares()}.items()
        ]
    )


def _coverage_row(name: str, coverage: Coverage, parameter: str, share: Share) -> dict[str, Any]:
    selected = [parameter in (POOLED, name) for name in coverage.names]
    scores = coverage.scores[:, selected]
    return {
        "measured": name,
        "unknown": coverage.world,
        "noise": coverage.noise,
        "parameter": parameter,
        "covered (%)": 100.0 * share.covered,
        "low (%)": 100.0 * share.low,
        "high (%)": 100.0 * share.high,
        "mean error (posterior sd)": float(np.nanmean(scores)),
        "sd of error (posterior sd)": float(np.nanstd(scores)),
        "hearts": share.sequences,
        "failed": int(np.isnan(coverage.scores).any(axis=1).sum()),
    }


def plot_sphere_coverage(coverages_by_group: Mapping[str, Sequence[Coverage]]) -> Figure:
    """Plot pooled coverage in each world, coverage of each parameter, and scores, one row per group of hearts."""
    table = sphere_coverage_table(coverages_by_group)
    figure = Figure(figsize=(13, 3.8 * len(coverages_by_group)), layout="constrained")
    panels = figure.subplots(len(coverages_by_group), 3, squeeze=False)
    for row, (name, coverages) in zip(panels, coverages_by_group.items(), strict=True):
        rows = table[table["measured"] == name]
        _shares(row[0], rows[rows["parameter"] == POOLED], "unknown")
        _shares(row[1], rows[(rows["unknown"] == SHOWN_WORLD) & (rows["parameter"] != POOLED)], "parameter")
        _scores(row[2], [coverage for coverage in coverages if coverage.world == SHOWN_WORLD])
        row[0].set_title(f"measured: {name}; all parameters", fontsize=10, loc="left")
        row[0].set_xlabel("unknown to the calibration")
        row[1].set_title("other parameters unknown, by parameter", fontsize=10, loc="left")
        row[2].set_title("other parameters unknown, scores; dotted: normal", fontsize=10, loc="left")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", frameon=False, fontsize=9, ncols=len(labels))
    return figure


def _shares(axes: Axes, rows: pd.DataFrame, by: str) -> None:
    labels = list(dict.fromkeys(rows[by]))
    noises = rows.groupby("noise", sort=False)
    for index, (noise, group) in enumerate(noises):
        places = [labels.index(label) + 0.16 * (index - (len(noises) - 1) / 2) for label in group[by]]
        share = group["covered (%)"]
        around = [share - group["low (%)"], group["high (%)"] - share]
        axes.errorbar(places, share, around, fmt="o", markersize=4, color=colour(index), label=noise)
    axes.axhline(NOMINAL_COVERAGE, color="black", linewidth=0.8, linestyle=":")
    axes.set_xticks(range(len(labels)), [symbol(label) for label in labels])
    axes.set_ylabel("truth in the 95 % interval (% of hearts)")
    axes.set_ylim(LEAST_COVERAGE, 101.0)
    clean(axes)


def _scores(axes: Axes, coverages: Sequence[Coverage]) -> None:
    edges = np.linspace(-SCORE_LIMIT, SCORE_LIMIT, 25)
    for index, coverage in enumerate(coverages):
        scores = np.clip(coverage.scores[np.isfinite(coverage.scores)], -SCORE_LIMIT, SCORE_LIMIT)
        axes.hist(
            scores,
            edges.tolist(),
            density=True,
            histtype="step",
            linewidth=1.4,
            color=colour(index),
            label=coverage.noise,
        )
    z = np.linspace(-SCORE_LIMIT, SCORE_LIMIT, 200)
    axes.plot(z, np.exp(-0.5 * z * z) / np.sqrt(2.0 * np.pi), "k:", linewidth=1.2, label="normal")
    axes.set_xlabel("error of the estimate (posterior sd)")
    axes.set_ylabel("density")
    clean(axes)
