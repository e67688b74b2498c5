"""The cause card as a figure that is read in ten seconds."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.diagnosis.cause import Diagnosis, Trace
from heartfit.diagnosis.departure import CLEAR, Departure, departures
from heartfit.geometry.arrays import Floats
from heartfit.observation.beat_phases import BeatPhases
from heartfit.tables.cause_card import CURVES, sentence, spoken, unit_of, wrong
from heartfit.tables.figures import ARTERY, CALIBRATED, MEASURED, REFERENCE, clean
from heartfit.tables.residual_table import NAMES

SHOWN = 8
"""Bars of the ranking."""
SHORT = {
    "isovolumic contraction": "IVC",
    "isovolumic relaxation": "IVR",
    "early filling": "early\nfilling",
    "diastasis": "dia-\nstasis",
    "atrial systole": "atrial\nsystole",
}
FEW = 50
"""Samples up to which each has a mark."""


def plot_cause(diagnosis: Diagnosis) -> Figure:
    """A row for each curve: measured and simulated, and what the simulation gets wrong in units of the noise.

    Over both the phases of the beat; shaded is the discrepancy with its 95 % band, the phase of its largest departure
    is marked and named. Beside them ln Bayes factors over none; below the dashed threshold nothing is claimed.
    """
    rows = len(diagnosis.traces)
    figure = Figure(figsize=(12.5, 1.4 + 2.6 * rows), layout="constrained")
    left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=(3.1, 1))[0]
    panels = left.subplots(rows, 2, squeeze=False, sharex=True)
    for row, trace, departure in zip(panels, diagnosis.traces, departures(diagnosis), strict=True):
        _curves(row[0], trace, diagnosis)
        _residuals(row[1], trace, diagnosis, departure)
    for axes in panels[-1]:
        axes.set_xlabel("time after trigger (s)")
        axes.set_xlim(0.0, diagnosis.period)
    panels[0, 0].legend(frameon=False, fontsize=8)
    panels[0, 1].legend(frameon=False, fontsize=8, loc="lower right")
    _ranking(right.subplots(), diagnosis)
    figure.suptitle(sentence(diagnosis), fontsize=11, fontweight="bold", wrap=True)
    return figure


def _curves(axes: Axes, trace: Trace, diagnosis: Diagnosis) -> None:
    unit, factor = unit_of(trace.curve)
    order, times = _in_one_beat(trace.times, diagnosis.period)
    axes.plot(times, factor * trace.measured[order], "o", color=MEASURED, markersize=2.8, label="measured")
    axes.plot(times, factor * trace.none[order], "--", color=ARTERY, linewidth=1.4, label="simulated")
    if diagnosis.mechanisms:
        extended = factor * trace.extended[order]
        axes.plot(times, extended, color=CALIBRATED, linewidth=1.4, label="with the cause")
    axes.set_ylabel(f"{CURVES.get(trace.curve, trace.curve)}\n({unit})", fontsize=9)
    _phases(axes, diagnosis.phases)
    clean(axes)


def _residuals(axes: Axes, trace: Trace, diagnosis: Diagnosis, departure: Departure) -> None:
    order, times = _in_one_beat(trace.times, diagnosis.period)
    noise = trace.noise[order]
    lacking = -trace.lacking[order] / noise
    axes.axhline(0.0, color="black", linewidth=0.6)
    low, high = ((side * 2.0 * trace.band - trace.lacking)[order] / noise for side in (-1.0, 1.0))
    axes.fill_between(times, low, high, color=REFERENCE, alpha=0.35, linewidth=0)
    mark = "o" if times.size < FEW else "."
    left = (trace.none - trace.measured)[order] / noise
    axes.plot(times, left, mark, color=ARTERY, markersize=3)
    axes.plot(
        times, -trace.lacking[order] / noise, color=MEASURED, linewidth=1.4, label="discrepancy, 95 % band"
    )
    if diagnosis.mechanisms:
        explained = (trace.extended - trace.measured)[order] / noise
        axes.plot(times, explained, mark, color=CALIBRATED, markersize=3)
    reach = 1.25 * max(2.0 * CLEAR, *np.abs([*left, *lacking]))
    axes.set_ylim(-reach, reach)
    axes.set_ylabel("simulated − measured\n(units of noise)", fontsize=9)
    _phases(axes, diagnosis.phases)
    _mark(axes, departure, diagnosis)
    clean(axes)


def _mark(axes: Axes, departure: Departure, diagnosis: Diagnosis) -> None:
    """The sentence of the departure, and its phase."""
    name, phases = NAMES.get(departure.curve, departure.curve), diagnosis.phases
    name += " (not searched)" if departure.curve in diagnosis.unsearched else ""
    if not departure.clear:
        axes.set_title(f"{name}: nothing beyond its noise", fontsize=10, pad=24)
        return
    said = f"{name} {wrong(departure)}: {abs(departure.deviations):.1f} sd"
    axes.set_title(said, fontsize=10, fontweight="bold", color=CALIBRATED, pad=24)
    for phase, start, end in [] if phases is None else phases.spans():
        if phase == departure.phase:
            axes.axvspan(start, end, color=CALIBRATED, alpha=0.12, linewidth=0)


def _phases(axes: Axes, phases: BeatPhases | None) -> None:
    """The beginning of each phase of the beat, and its name where there is room."""
    for name, start, end in [] if phases is None else phases.spans():
        axes.axvline(start, color="black", linewidth=0.5, linestyle=":")
        if phases is not None and end - start > 0.04 * phases.period:
            middle, above = 0.5 * (start + end), axes.get_xaxis_transform()
            said = SHORT.get(name, name)
            axes.text(middle, 1.01, said, transform=above, ha="center", va="bottom", fontsize=7)


def _in_one_beat(times: Floats, period: float) -> tuple[np.ndarray, Floats]:
    """The order of samples by their phase, and those times."""
    inside = np.mod(times, period)
    order = np.argsort(inside, kind="stable")
    return order, inside[order]


def _ranking(axes: Axes, diagnosis: Diagnosis) -> None:
    shown = list(diagnosis.ranking.items())[:SHOWN][::-1]
    named = {each.name for each in diagnosis.mechanisms} or {diagnosis.verdict}
    colours = [CALIBRATED if name in named else REFERENCE for name, _ in shown]
    axes.barh(range(len(shown)), [max(value, 0.0) for _, value in shown], color=colours)
    axes.set_yticks(range(len(shown)), [spoken(name) for name, _ in shown], fontsize=8)
    axes.axvline(diagnosis.threshold, color="black", linewidth=0.8, linestyle="--")
    axes.set_xlabel("ln Bayes factor\nover none", fontsize=9)
    axes.set_xlim(0.0, max(1.3 * diagnosis.threshold, 1.05 * max((value for _, value in shown), default=0.0)))
    clean(axes)
