"""How often intervals hold the truth on the spheres, as a table and a figure."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.observation.coverage import Share
from heartfit.tables.figures import clean, colour
from heartfit.tables.text import symbol
from heartfit.twins.coverage import Coverage

POOLED = "all"
WANTED = 95.0
SHOWN = "parameters"
"""The world of the panels that show one."""
LOWEST = 50.0
"""Percent, the least share that is shown."""
NEAREST = 4.0
"""Scores beyond it are counted in the outermost bars."""


def sphere_coverage_table(seen: Mapping[str, Sequence[Coverage]]) -> pd.DataFrame:
    """One row per group of hearts, world, noise and parameter: the share in the 95 % interval, and its own interval.

    Errors of the estimates are in standard deviations of their posteriors: mean 0 and deviation 1 if all is said.
    A calibration that failed is not covered. The row "all" pools the parameters; its trials are the hearts.
    """
    return pd.DataFrame(
        [
            _row(name, coverage, parameter, share)
            for name, coverages in seen.items()
            for coverage in coverages
            for parameter, share in {POOLED: coverage.pooled(), **coverage.shares()}.items()
        ]
    )


def _row(name: str, coverage: Coverage, parameter: str, share: Share) -> dict[str, Any]:
    own = [parameter in (POOLED, each) for each in coverage.names]
    scores = coverage.scores[:, own]
    return {
        "measured": name,
        "unknown": coverage.world,
        "noise": coverage.way,
        "parameter": parameter,
        "covered (%)": 100.0 * share.covered,
        "low (%)": 100.0 * share.low,
        "high (%)": 100.0 * share.high,
        "mean error (posterior sd)": float(np.nanmean(scores)),
        "sd of error (posterior sd)": float(np.nanstd(scores)),
        "hearts": share.sequences,
        "failed": int(np.isnan(coverage.scores).any(axis=1).sum()),
    }


def plot_sphere_coverage(seen: Mapping[str, Sequence[Coverage]]) -> Figure:
    """By group of hearts: pooled shares in each world, shares of each parameter and scores where values scatter."""
    table = sphere_coverage_table(seen)
    figure = Figure(figsize=(13, 3.8 * len(seen)), layout="constrained")
    panels = figure.subplots(len(seen), 3, squeeze=False)
    for row, (name, coverages) in zip(panels, seen.items(), strict=True):
        rows = table[table["measured"] == name]
        _shares(row[0], rows[rows["parameter"] == POOLED], "unknown")
        _shares(row[1], rows[(rows["unknown"] == SHOWN) & (rows["parameter"] != POOLED)], "parameter")
        _scores(row[2], [coverage for coverage in coverages if coverage.world == SHOWN])
        row[0].set_title(f"measured: {name}; all parameters", fontsize=10, loc="left")
        row[0].set_xlabel("what the calibrator does not know")
        row[1].set_title("other parameters unknown; by parameter", fontsize=10, loc="left")
        row[2].set_title("the same; dotted: normal", fontsize=10, loc="left")
    handles, labels = panels[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", frameon=False, fontsize=9, ncols=len(labels))
    return figure


def _shares(axes: Axes, rows: pd.DataFrame, by: str) -> None:
    labels = list(dict.fromkeys(rows[by]))
    ways = rows.groupby("noise", sort=False)
    for index, (way, group) in enumerate(ways):
        places = [labels.index(label) + 0.16 * (index - (len(ways) - 1) / 2) for label in group[by]]
        share = group["covered (%)"]
        around = [share - group["low (%)"], group["high (%)"] - share]
        axes.errorbar(places, share, around, fmt="o", markersize=4, color=colour(index), label=way)
    axes.axhline(WANTED, color="black", linewidth=0.8, linestyle=":")
    axes.set_xticks(range(len(labels)), [symbol(label) for label in labels])
    axes.set_ylabel("truth in the 95 % interval (% of hearts)")
    axes.set_ylim(LOWEST, 101.0)
    clean(axes)


def _scores(axes: Axes, coverages: Sequence[Coverage]) -> None:
    edges = np.linspace(-NEAREST, NEAREST, 25)
    for index, coverage in enumerate(coverages):
        scores = np.clip(coverage.scores[np.isfinite(coverage.scores)], -NEAREST, NEAREST)
        axes.hist(
            scores,
            edges.tolist(),
            density=True,
            histtype="step",
            linewidth=1.4,
            color=colour(index),
            label=coverage.way,
        )
    z = np.linspace(-NEAREST, NEAREST, 200)
    axes.plot(z, np.exp(-0.5 * z * z) / np.sqrt(2.0 * np.pi), "k:", linewidth=1.2, label="normal")
    axes.set_xlabel("error of the estimate (posterior sd)")
    axes.set_ylabel("density")
    clean(axes)
