"""Figures of the benchmark of hidden effects: confusion, power and detection."""

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from heartfit.discovery.inference.decide import CENTRED_RULES, DEFAULT_RULES
from heartfit.results.figures import ARTERY, ATRIUM, CALIBRATED, REFERENCE, clean
from heartfit.results.planted_table import printed_size
from heartfit.synthetic.scoring import RATES, Rate, Scored

CONFUSION_KINDS = ("none", "single", "outside")
KIND_MARKS = ("", "", " *")
EXPECTED_ANSWER = {0: "none", 2: "unknown"}
"""Correct conclusion for kinds without a correct name."""
LAST_COLUMNS = ("group", "two", "unknown", "none", "insufficient")
"""Columns of the confusion matrix after the mechanisms."""
POWER_COLUMNS = 5
"""Panels per row of the figure of power."""
OUTCOMES: dict[str, tuple[Callable[[Scored], bool], str, str]] = {
    "named right": (lambda case: case.right, ATRIUM, "o"),
    "named wrong": (lambda case: case.named, CALIBRATED, "X"),
    "group or unknown": (lambda case: case.detected, ARTERY, "s"),
    "not detected": (lambda case: not case.detected, REFERENCE, "v"),
}
"""Predicate, colour and marker; the first true predicate is the outcome of a case."""


def plot_confusion(scored: Sequence[Scored]) -> Figure:
    """Plot counts of conclusions (columns) by planted effect (rows): none, singles, out-of-library effects."""
    cases = [case for case in scored if case.answer.kind in CONFUSION_KINDS]
    rows = sorted({(CONFUSION_KINDS.index(case.answer.kind), case.planted) for case in cases})
    conclusions = {case.conclusion for case in cases}
    last = [verdict for verdict in LAST_COLUMNS if verdict in conclusions]
    columns = [*sorted(conclusions - set(LAST_COLUMNS)), *last]
    counts = np.zeros((len(rows), len(columns)), int)
    for case in cases:
        counts[
            rows.index((CONFUSION_KINDS.index(case.answer.kind), case.planted)),
            columns.index(case.conclusion),
        ] += 1
    figure = Figure(figsize=(3.2 + 0.34 * len(columns), 2.2 + 0.27 * len(rows)), layout="constrained")
    axes = figure.subplots()
    axes.imshow(counts / counts.sum(axis=1, keepdims=True), cmap="Blues", vmax=1.4, aspect="auto")
    for (i, j), count in np.ndenumerate(counts):
        if count:
            weight = "bold" if columns[j] == EXPECTED_ANSWER.get(rows[i][0], rows[i][1]) else "normal"
            axes.text(j, i, str(count), ha="center", va="center", fontsize=8, weight=weight)
    axes.set_xticks(range(len(columns)), columns, rotation=90, fontsize=8)
    axes.set_yticks(range(len(rows)), [f"{name}{KIND_MARKS[kind]}" for kind, name in rows], fontsize=8)
    axes.set_xlabel("conclusion")
    axes.set_ylabel("planted")
    axes.set_title("number of cases; bold: correct; * outside the library", fontsize=9, loc="left")
    return figure


def plot_rates(scored: Sequence[Scored], rates: Sequence[Rate] = RATES) -> Figure:
    """Plot each rate with its exact 95 % interval, and its target as a bar across."""
    shares = [(rate, share) for rate in rates if (share := rate.share_of(scored)) is not None]
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
    """Plot the ln Bayes factor of the planted mechanism over its size, by mechanism, with the outcome."""
    singles = [case for case in scored if case.answer.kind == "single"]
    names = sorted({case.planted for case in singles})
    rows = max(1, -(-len(names) // POWER_COLUMNS))
    figure = Figure(figsize=(12, 0.8 + 1.9 * rows), layout="constrained")
    panels = figure.subplots(rows, POWER_COLUMNS, squeeze=False)
    for axes in panels.ravel():
        axes.set_visible(False)
    for name, axes in zip(names, panels.ravel(), strict=False):
        _power(axes, name, [case for case in singles if case.planted == name])
    for axes in panels[:, 0]:
        axes.set_ylabel("ln Bayes factor", fontsize=8)
    _outcome_legend(figure)
    return figure


def _outcome_legend(figure: Figure) -> None:
    handles = [
        Line2D([], [], color=colour, marker=marker, linestyle="none", label=label)
        for label, (_, colour, marker) in OUTCOMES.items()
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=len(OUTCOMES), frameon=False, fontsize=9)


def _outcome_style(case: Scored) -> tuple[str, str]:
    """Return colour and marker of the outcome of a case."""
    return next((colour, marker) for holds, colour, marker in OUTCOMES.values() if holds(case))


def _power(axes: Axes, name: str, cases: Sequence[Scored]) -> None:
    axes.set_visible(True)
    for case in cases:
        size, unit = printed_size(case.answer.effects[0])
        colour, marker = _outcome_style(case)
        axes.plot(size, case.finding.ranking.get(name, np.nan), marker, color=colour, markersize=5, alpha=0.8)
        axes.set_xlabel(unit or "1", fontsize=8)
    axes.axhline(DEFAULT_RULES.detected, color="black", linewidth=0.7, linestyle=":")
    axes.set_yscale("symlog", linthresh=10.0)
    axes.set_yticks([0, 5, 10, 100, 1000], ["0", "5", "10", "100", "1000"], fontsize=7)
    axes.set_ylim(-3.0, 3000.0)
    axes.margins(x=0.12)
    axes.set_xlim(left=0.0)
    axes.tick_params(labelsize=7)
    axes.set_title(name, fontsize=8.5, loc="left")
    clean(axes)


CASE_SPACING = 0.14
"""Distance between the cases of one row [rows]."""


def plot_ventricles(scored: Sequence[Scored]) -> Figure:
    """Plot the largest ln Bayes factor of each case with its outcome, one row per effect."""
    rows = sorted({case.planted for case in scored}, key=lambda name: (name != "nothing", name))
    figure = Figure(figsize=(7.5, 1.3 + 0.32 * len(rows)), layout="constrained")
    axes = figure.subplots()
    for place, name in enumerate(rows):
        cases = [case for case in scored if case.planted == name]
        for number, case in enumerate(cases):
            colour, marker = _outcome_style(case)
            height = place + CASE_SPACING * (number - 0.5 * (len(cases) - 1))
            axes.plot(_largest_factor(case), height, marker, color=colour, markersize=6, alpha=0.85)
    axes.axvline(CENTRED_RULES.detected, color="black", linewidth=0.8, linestyle=":")
    axes.set_yticks(range(len(rows)), rows, fontsize=9)
    axes.invert_yaxis()
    axes.set_xscale("symlog", linthresh=10.0)
    axes.set_xlim(-3.0, 1000.0)
    axes.set_xticks([0, 5, 10, 100, 1000], ["0", "5", "10", "100", "1000"])
    axes.set_xlabel("largest ln Bayes factor over baseline; dotted: detection threshold")
    axes.grid(axis="y", color="0.93")
    clean(axes)
    _outcome_legend(figure)
    return figure


def _largest_factor(case: Scored) -> float:
    return max(case.finding.ranking.values(), default=0.0)
