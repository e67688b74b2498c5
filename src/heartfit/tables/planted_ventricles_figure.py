"""What a search for causes said of effects hidden in three dimensions, drawn case by case."""

from collections.abc import Sequence

from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from heartfit.discovery.rules import CENTRED
from heartfit.planting.scoring import Scored
from heartfit.tables.figures import clean
from heartfit.tables.planted_figures import OUTCOMES

FURTHER = 0.14
"""Between cases of one row, in rows."""


def plot_ventricles(scored: Sequence[Scored]) -> Figure:
    """Largest ln Bayes factor of each case, a row for each effect, and what was said of it."""
    rows = sorted({each.planted for each in scored}, key=lambda name: (name != "nothing", name))
    figure = Figure(figsize=(7.5, 1.3 + 0.32 * len(rows)), layout="constrained")
    axes = figure.subplots()
    for place, name in enumerate(rows):
        cases = [each for each in scored if each.planted == name]
        for number, each in enumerate(cases):
            _, colour, marker = next(style for style in OUTCOMES.values() if style[0](each))
            height = place + FURTHER * (number - 0.5 * (len(cases) - 1))
            axes.plot(_best(each), height, marker, color=colour, markersize=6, alpha=0.85)
    axes.axvline(CENTRED.detected, color="black", linewidth=0.8, linestyle=":")
    axes.set_yticks(range(len(rows)), rows, fontsize=9)
    axes.invert_yaxis()
    axes.set_xscale("symlog", linthresh=10.0)
    axes.set_xlim(-3.0, 1000.0)
    axes.set_xticks([0, 5, 10, 100, 1000], ["0", "5", "10", "100", "1000"])
    axes.set_xlabel("largest ln Bayes factor over none; dotted: least to be detected")
    axes.grid(axis="y", color="0.93")
    clean(axes)
    handles = [
        Line2D([], [], color=colour, marker=marker, linestyle="none", label=label)
        for label, (_, colour, marker) in OUTCOMES.items()
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=len(OUTCOMES), frameon=False, fontsize=9)
    return figure


def _best(each: Scored) -> float:
    return max(each.finding.ranking.values(), default=0.0)
