"""What extending a model gains where nothing was fitted, mechanism by mechanism."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.diagnosis.cause import Attempt
from heartfit.tables.attempts_table import JUDGES, by_gain, gains_of
from heartfit.tables.cause_card import spoken
from heartfit.tables.figures import ARTERY, CALIBRATED, MEASURED, REFERENCE, clean

SHOWN = 2
"""Mechanisms whose volumes are drawn."""
STYLES = ((CALIBRATED, "-"), (ARTERY, "--"))


def plot_attempts(attempts: Sequence[Attempt], title: str) -> Figure:
    """The left volume with and without the best mechanisms, and the error ratios of all with their 95 % intervals.

    Filled circles in the first panel are frames that were fitted, open ones those that judge.
    """
    ordered = by_gain(attempts)
    judges = list(gains_of(ordered[0]))
    figure = Figure(
        figsize=(4.2 + 2.0 * len(judges), 1.9 + 0.32 * max(len(ordered), 6)), layout="constrained"
    )
    left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=(4.2, 2.2 * len(judges)))[0]
    _volumes(left.subplots(), ordered[:SHOWN])
    panels = right.subplots(1, len(judges), sharey=True, squeeze=False)[0]
    for axes, judge in zip(panels, judges, strict=True):
        _ratios(axes, ordered, judge)
    panels[0].set_yticks(range(len(ordered)), [spoken(_name(each)) for each in ordered], fontsize=8.5)
    panels[0].invert_yaxis()
    right.supxlabel(
        "error with the mechanism over error without, 95 % interval; below 1 it helps", fontsize=9
    )
    figure.suptitle(f"{title}: what each mechanism would gain on what was not fitted", fontsize=11)
    return figure


def _name(attempt: Attempt) -> str:
    return attempt.refitted.extension[0].name


def _volumes(axes: Axes, best: Sequence[Attempt]) -> None:
    trace = next(each for each in best[0].traces if each.curve == "lv_volume")
    fitted = np.arange(trace.times.size) % 2 == 0
    for part, filled, label in (
        (fitted, MEASURED, "measured, fitted"),
        (~fitted, "white", "measured, kept to judge"),
    ):
        axes.plot(
            trace.times[part], 1e6 * trace.measured[part], "o", color=MEASURED,
            markerfacecolor=filled, markersize=3.8, label=label, zorder=3,
        )  # fmt: skip
    axes.plot(trace.times, 1e6 * trace.none, ":", color=REFERENCE, linewidth=2.0, label="without any")
    for attempt, (shade, line) in zip(best, STYLES, strict=False):
        extended = next(each for each in attempt.traces if each.curve == "lv_volume").extended
        axes.plot(trace.times, 1e6 * extended, line, color=shade, linewidth=1.5, label=spoken(_name(attempt)))
    axes.set_xlabel("time after trigger (s)", fontsize=9)
    axes.set_ylabel("LV volume (mL)", fontsize=9)
    axes.legend(frameon=False, fontsize=8)
    clean(axes)


def _ratios(axes: Axes, attempts: Sequence[Attempt], judge: str) -> None:
    axes.axvline(1.0, color="black", linewidth=0.8, linestyle="--")
    for row, gain in enumerate(gains_of(each)[judge] for each in attempts):
        shade = CALIBRATED if gain.interval[1] < 1.0 else ARTERY if gain.interval[0] > 1.0 else REFERENCE
        axes.plot(gain.interval, (row, row), color=shade, linewidth=1.6)
        axes.plot(gain.ratio, row, "o", color=shade, markersize=5)
    axes.set_title(JUDGES[judge].replace(", ", ",\n"), fontsize=9)
    axes.tick_params(labelsize=8)
    clean(axes)
