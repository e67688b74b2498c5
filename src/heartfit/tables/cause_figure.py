"""The cause card as a figure that is read in ten seconds."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.diagnosis.cause import Diagnosis, Trace
from heartfit.tables.cause_card import CURVES, UNITS, sentence, spoken
from heartfit.tables.figures import ARTERY, CALIBRATED, MEASURED, REFERENCE, clean

SHOWN = 8
"""Bars of the ranking."""


def plot_cause(diagnosis: Diagnosis) -> Figure:
    """A row for each curve: measured and simulated, residuals in units of noise, and what the simulation lacks.

    Beside them ln Bayes factors over none; dashed is the threshold, below which nothing is claimed.
    """
    rows = len(diagnosis.traces)
    figure = Figure(figsize=(12.5, 1.2 + 2.7 * rows), layout="constrained")
    left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=(3.1, 1))[0]
    panels = left.subplots(rows, 3, squeeze=False, sharex=True)
    for row, trace in zip(panels, diagnosis.traces, strict=True):
        _curves(row[0], trace, bool(diagnosis.mechanisms))
        _residuals(row[1], trace, bool(diagnosis.mechanisms))
        _lacking(row[2], trace)
    for axes in panels[-1]:
        axes.set_xlabel("time after trigger (s)")
    panels[0, 0].legend(frameon=False, fontsize=8)
    _ranking(right.subplots(), diagnosis)
    figure.suptitle(sentence(diagnosis), fontsize=11, fontweight="bold", wrap=True)
    return figure


def _units(trace: Trace) -> tuple[str, float]:
    return UNITS["m^3" if trace.curve.endswith("_volume") else "Pa"]


def _curves(axes: Axes, trace: Trace, named: bool) -> None:
    unit, factor = _units(trace)
    axes.plot(trace.times, factor * trace.measured, "o", color=MEASURED, markersize=2.8, label="measured")
    axes.plot(trace.times, factor * trace.none, "--", color=ARTERY, linewidth=1.4, label="simulated")
    if named:
        axes.plot(
            trace.times, factor * trace.extended, color=CALIBRATED, linewidth=1.4, label="with the cause"
        )
    name = CURVES.get(trace.curve, trace.curve)
    axes.set_ylabel(
        f"{name.removeprefix('left ventricular ').removeprefix('right ventricular ').removeprefix('aortic ')} ({unit})"
    )
    axes.set_title(name, fontsize=9)
    clean(axes)


def _residuals(axes: Axes, trace: Trace, named: bool) -> None:
    axes.axhspan(-2.0, 2.0, color="#eeeeee")
    axes.plot(trace.times, (trace.measured - trace.none) / trace.noise, ".--", color=ARTERY, linewidth=0.8)
    if named:
        axes.plot(
            trace.times,
            (trace.measured - trace.extended) / trace.noise,
            ".-",
            color=CALIBRATED,
            linewidth=0.8,
        )
    reach = max(4.0, 1.1 * float(np.abs((trace.measured - trace.none) / trace.noise).max()))
    axes.set_ylim(-reach, reach)
    axes.set_title("measured less simulated, over the noise", fontsize=9)
    clean(axes)


def _lacking(axes: Axes, trace: Trace) -> None:
    unit, factor = _units(trace)
    low, high = (factor * (trace.lacking + side * trace.band) for side in (-2.0, 2.0))
    axes.fill_between(trace.times, low, high, color=REFERENCE, alpha=0.4, linewidth=0)
    axes.plot(trace.times, factor * trace.lacking, color=MEASURED, linewidth=1.4)
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.set_title(f"what the simulation lacks ({unit}), 95 % band", fontsize=9)
    clean(axes)


def _ranking(axes: Axes, diagnosis: Diagnosis) -> None:
    shown = list(diagnosis.ranking.items())[:SHOWN][::-1]
    named = {each.name for each in diagnosis.mechanisms}
    colours = [CALIBRATED if name in named else REFERENCE for name, _ in shown]
    axes.barh(range(len(shown)), [max(value, 0.0) for _, value in shown], color=colours)
    axes.set_yticks(range(len(shown)), [spoken(name) for name, _ in shown], fontsize=8)
    axes.axvline(diagnosis.threshold, color="black", linewidth=0.8, linestyle="--")
    axes.set_xlabel("ln Bayes factor over none")
    axes.set_xlim(0.0, max(1.3 * diagnosis.threshold, 1.05 * max((value for _, value in shown), default=0.0)))
    clean(axes)
