"""Patients beside volunteers, parameter by parameter, as estimated and in truth."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter, ScalarFormatter

from heartfit.calibration.information import SEEN
from heartfit.tables.figures import ARTERY, CALIBRATED, clean
from heartfit.tables.specificity import READINGS, STANDS_FOR, Comparison
from heartfit.tables.specificity_table import STIFF, STIFFNESS, WEAK
from heartfit.tables.text import symbol

MARKERS = ("^", "s", "v", "D")
LABELS = {"observations met": "met", "noise and fixed": "weighed", "unshrunk": "unshrunk", "truth": "truth"}
CLAIMED = {"sigma_0": WEAK} | dict.fromkeys(STIFFNESS, STIFF)
TICKS = (0.5, 0.7, 1.0, 1.4, 2.0)


def plot_specificity(comparisons: Sequence[Comparison]) -> Figure:
    """One row per setting, one panel per parameter that is estimated in everybody: ratios to the healthy mean.

    In each panel a column per reading, with the exact p. A panel on grey is one whose difference the data hardly see;
    dotted is what the paper claims of its patients.
    """
    columns = max((len(each.names) for each in comparisons), default=1)
    rows = max(len(comparisons), 1)
    figure = Figure(figsize=(2.6 * columns + 0.6, 2.7 * rows + 0.4), layout="constrained")
    panels = figure.subplots(rows, columns, squeeze=False, sharey=True)
    for axes in panels.ravel():
        axes.set_visible(False)
    for each, row in zip(comparisons, panels, strict=False):
        for name, axes in zip(each.names, row, strict=False):
            axes.set_visible(True)
            _panel(axes, each, name)
        row[0].set_ylabel(f"{each.setting}\nratio to the healthy mean", fontsize=9)
    if comparisons:
        handles, labels = panels[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper center", ncols=6, frameon=False, fontsize=9)
    return figure


def _panel(axes: Axes, each: Comparison, name: str) -> None:
    for place, reading in enumerate(READINGS):
        ratios = each.ratios(reading, name)
        if ratios:
            _column(axes, each, place, ratios)
            axes.text(
                place, 1.01, f"p {each.test(reading, name).p:.2f}", transform=axes.get_xaxis_transform(),
                ha="center", va="bottom", fontsize=7,
            )  # fmt: skip
    seen = 1.0 - float(each.seen.sd_ratio[each.names.index(name)]) ** 2
    if seen < SEEN:
        axes.set_facecolor("#e9e9e9")
    stands = f" (truth: {symbol(STANDS_FOR[name])})" if name in STANDS_FOR else ""
    axes.set_title(f"{symbol(name)}{stands}, seen {100 * seen:.0f} %", fontsize=9, pad=14)
    if name in CLAIMED:
        axes.axhline(CLAIMED[name], color=CALIBRATED, linewidth=0.9, linestyle=":")
    _scale(axes)


def _column(axes: Axes, each: Comparison, place: int, ratios: dict[str, float]) -> None:
    healthy = [ratios[card.case] for card in each.volunteers]
    first = place == 0
    axes.plot(
        [place] * len(healthy), healthy, "o", color=ARTERY, alpha=0.55, markersize=5, markeredgewidth=0,
        label="volunteers" if first else None,
    )  # fmt: skip
    offsets = np.linspace(-0.15, 0.15, len(each.patients))
    for card, marker, offset in zip(each.patients, MARKERS, offsets, strict=False):
        axes.plot(
            place + offset, ratios[card.case], marker, color=CALIBRATED, markersize=6.5, markeredgecolor="black",
            markeredgewidth=0.6, linestyle="none", label=card.case if first else None,
        )  # fmt: skip


def _scale(axes: Axes) -> None:
    axes.axhline(1.0, color="black", linewidth=0.6)
    axes.set_yscale("log")
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, 0.48), max(high, 2.1))
    axes.set_yticks(TICKS)
    axes.yaxis.set_major_formatter(ScalarFormatter())
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_xticks(range(len(READINGS)), [LABELS[reading] for reading in READINGS], fontsize=7)
    axes.set_xlim(-0.5, len(READINGS) - 0.5)
    axes.tick_params(axis="y", labelsize=8)
    clean(axes)
