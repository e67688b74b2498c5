"""What a search for causes said of hidden effects, drawn: confusion, power and detection."""

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from heartfit.discovery.rules import RULES
from heartfit.planting.rates import RATES, Rate
from heartfit.planting.scoring import Scored
from heartfit.tables.figures import ARTERY, ATRIUM, CALIBRATED, REFERENCE, clean
from heartfit.tables.planted_table import printed_size

KINDS = ("none", "single", "outside")
MARKS = ("", "", " *")
EXPECTED = {0: "none", 2: "unknown"}
"""What should be said of kinds of which no name is right."""
LAST = ("group", "two", "unknown", "none", "insufficient")
"""Columns of the confusion matrix after the names."""
PANELS = 5
"""Panels of the figure of power beside each other."""
OUTCOMES: dict[str, tuple[Callable[[Scored], bool], str, str]] = {
    "named right": (lambda each: each.right, ATRIUM, "o"),
    "named wrong": (lambda each: each.named, CALIBRATED, "X"),
    "group or unknown": (lambda each: each.detected, ARTERY, "s"),
    "not detected": (lambda each: not each.detected, REFERENCE, "v"),
}
"""The first that holds of a case is its outcome."""


def plot_confusion(scored: Sequence[Scored]) -> Figure:
    """Counts of what was said (columns) of what was planted (rows): nothing, singles, then outsiders."""
    cases = [each for each in scored if each.answer.kind in KINDS]
    rows = sorted({(KINDS.index(each.answer.kind), each.planted) for each in cases})
    said = {each.said for each in cases}
    columns = [*sorted(said - set(LAST)), *(each for each in LAST if each in said)]
    counts = np.zeros((len(rows), len(columns)), int)
    for each in cases:
        counts[rows.index((KINDS.index(each.answer.kind), each.planted)), columns.index(each.said)] += 1
    figure = Figure(figsize=(3.2 + 0.34 * len(columns), 2.2 + 0.27 * len(rows)), layout="constrained")
    axes = figure.subplots()
    axes.imshow(counts / counts.sum(axis=1, keepdims=True), cmap="Blues", vmax=1.4, aspect="auto")
    for (i, j), count in np.ndenumerate(counts):
        if count:
            weight = "bold" if columns[j] == EXPECTED.get(rows[i][0], rows[i][1]) else "normal"
            axes.text(j, i, str(count), ha="center", va="center", fontsize=8, weight=weight)
    axes.set_xticks(range(len(columns)), columns, rotation=90, fontsize=8)
    axes.set_yticks(range(len(rows)), [f"{name}{MARKS[kind]}" for kind, name in rows], fontsize=8)
    axes.set_xlabel("said")
    axes.set_ylabel("planted")
    axes.set_title("numbers of cases; bold: right; * outside the library", fontsize=9, loc="left")
    return figure


def plot_rates(scored: Sequence[Scored], rates: Sequence[Rate] = RATES) -> Figure:
    """Every rate with its exact 95 % interval and, as a bar across, its target."""
    shares = [(rate, share) for rate in rates if (share := rate.counted(scored)) is not None]
    figure = Figure(figsize=(8.5, 0.6 + 0.34 * len(shares)), layout="constrained")
    axes = figure.subplots()
    for place, (rate, share) in enumerate(shares):
        around = [[share.covered - share.low], [share.high - share.covered]]
        axes.errorbar(
            100 * share.covered, place, xerr=100 * np.array(around), fmt="o", color=ARTERY, markersize=5
        )
        if rate.target is not None:
            better = "<" if rate.at_most else ">"
            axes.plot(100 * rate.target, place, marker=better, color=CALIBRATED, markersize=9, zorder=0)
            axes.plot([100 * rate.target] * 2, [place - 0.35, place + 0.35], color=CALIBRATED, linewidth=2)
    axes.set_yticks(
        range(len(shares)), [f"{rate.name}  (n = {share.sequences})" for rate, share in shares], fontsize=9
    )
    axes.set_xlim(-2, 102)
    axes.invert_yaxis()
    axes.set_xlabel("share of cases (%), exact 95 % interval; vermilion: target")
    axes.grid(axis="x", color="0.9")
    clean(axes)
    return figure


def plot_power(scored: Sequence[Scored]) -> Figure:
    """By mechanism: ln Bayes factor of what was planted over its size, in its unit, and what was said."""
    singles = [each for each in scored if each.answer.kind == "single"]
    names = sorted({each.planted for each in singles})
    rows = max(1, -(-len(names) // PANELS))
    figure = Figure(figsize=(12, 0.8 + 1.9 * rows), layout="constrained")
    panels = figure.subplots(rows, PANELS, squeeze=False)
    for axes in panels.ravel():
        axes.set_visible(False)
    for name, axes in zip(names, panels.ravel(), strict=False):
        _power(axes, name, [each for each in singles if each.planted == name])
    for axes in panels[:, 0]:
        axes.set_ylabel("ln Bayes factor", fontsize=8)
    handles = [
        Line2D([], [], color=colour, marker=marker, linestyle="none", label=label)
        for label, (_, colour, marker) in OUTCOMES.items()
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=len(OUTCOMES), frameon=False, fontsize=9)
    return figure


def _power(axes: Axes, name: str, cases: Sequence[Scored]) -> None:
    axes.set_visible(True)
    for each in cases:
        size, unit = printed_size(each.answer.effects[0])
        _, colour, marker = next(style for style in OUTCOMES.values() if style[0](each))
        axes.plot(size, each.finding.ranking.get(name, np.nan), marker, color=colour, markersize=5, alpha=0.8)
        axes.set_xlabel(unit or "1", fontsize=8)
    axes.axhline(RULES.detected, color="black", linewidth=0.7, linestyle=":")
    axes.set_yscale("symlog", linthresh=10.0)
    axes.set_yticks([0, 5, 10, 100, 1000], ["0", "5", "10", "100", "1000"], fontsize=7)
    axes.set_ylim(-3.0, 3000.0)
    axes.margins(x=0.12)
    axes.set_xlim(left=0.0)
    axes.tick_params(labelsize=7)
    axes.set_title(name, fontsize=8.5, loc="left")
    clean(axes)
