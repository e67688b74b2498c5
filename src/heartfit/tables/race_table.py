"""Methods of calibration beside each other, as a table and a figure."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.tables.figures import clean, colour
from heartfit.twins.race import Mark

QUARTILES = (25.0, 50.0, 75.0)
ERRORS = {
    "observations": "error of the observations (%)",
    "parameters": "error of the parameters (prior sd)",
}
PRIOR, PUBLISHED = "prior", "unscented, R = 0"
MARKERS = "osD^vP"
APART = 0.35
"""Simulations between methods whose bars would cover each other."""


def race_table(seen: Mapping[str, Sequence[Mark]]) -> pd.DataFrame:
    """One row per group of hearts, method and number of simulations: median and quartiles over the hearts.

    "hearts": those that the method finished, and whose estimate has a beat.
    """
    return pd.DataFrame([row for name, marks in seen.items() for row in _rows(name, marks)])


def _rows(name: str, marks: Sequence[Mark]) -> list[dict[str, Any]]:
    methods = list(dict.fromkeys(mark.method for mark in marks))
    ordered = sorted(marks, key=lambda mark: (methods.index(mark.method), mark.simulations))
    return [
        _row(name, method, simulations, [mark for mark in group if np.isfinite(mark.observations)])
        for (method, simulations), group in groupby(ordered, lambda mark: (mark.method, mark.simulations))
    ]


def _row(name: str, method: str, simulations: int, marks: Sequence[Mark]) -> dict[str, Any]:
    row: dict[str, Any] = {
        "measured": name,
        "method": method,
        "simulations": simulations,
        "hearts": len(marks),
    }
    for what in ERRORS:
        values = [getattr(mark, what) for mark in marks] or [np.nan]
        low, median, high = np.percentile(values, QUARTILES).tolist()
        unit = "%" if what == "observations" else "prior sd"
        row |= {f"{what} ({unit})": median, f"{what}, lower": low, f"{what}, upper": high}
    return row


def plot_race(table: pd.DataFrame) -> Figure:
    """Errors of observations and parameters over the number of simulations, one row per group of hearts."""
    groups = list(table.groupby("measured", sort=False))
    figure = Figure(figsize=(10, 0.5 + 3.4 * len(groups)), layout="constrained")
    panels = figure.subplots(len(groups), 2, squeeze=False)
    for row, (name, rows) in zip(panels, groups, strict=True):
        for axes, what in zip(row, ERRORS, strict=True):
            _methods(axes, rows, what)
        row[0].set_title(f"measured: {name}", fontsize=10, loc="left")
    handles, labels = panels[0, 1].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", frameon=False, fontsize=9, ncols=4)
    return figure


def _methods(axes: Axes, rows: pd.DataFrame, what: str) -> None:
    unit = "%" if what == "observations" else "prior sd"
    middle = f"{what} ({unit})"
    prior = rows[rows["method"] == PRIOR]
    if len(prior):
        axes.axhline(prior[middle].iloc[0], color="0.6", linewidth=1.0, linestyle="--", label=PRIOR)
    others = rows[rows["method"] != PRIOR].groupby("method", sort=False)
    for index, (method, group) in enumerate(others):
        x = group["simulations"] + APART * (index - (len(others) - 1) / 2)
        around = [group[middle] - group[f"{what}, lower"], group[f"{what}, upper"] - group[middle]]
        style = {"color": colour(index), "marker": MARKERS[index % len(MARKERS)], "label": method}
        axes.errorbar(x, group[middle], around, markersize=4.5, linewidth=1.3, elinewidth=0.7, **style)
    _ring(axes, rows[rows["method"] == PUBLISHED], middle, -APART * (len(others) - 1) / 2)
    axes.set_xlabel("simulations of a heart")
    axes.set_ylabel(ERRORS[what])
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    clean(axes)


def _ring(axes: Axes, rows: pd.DataFrame, middle: str, offset: float) -> None:
    """Around the single step of the paper."""
    if len(rows):
        first = rows.iloc[0]
        place = first["simulations"] + offset, first[middle]
        axes.plot(*place, "o", markersize=13, fillstyle="none", color="black", label="the paper's step")
