"""Cause card as a figure."""

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.cause import CLEAR_DEVIATIONS, Departure, Diagnosis, Trace, departures
from heartfit.observation.beat import BeatPhases
from heartfit.results.acting_figure import plot_functions
from heartfit.results.cause_card import (
    CURVES,
    candidate_names,
    departure_sentences,
    direction_and_phase,
    markdown_card,
    spaced_name,
    verdict_sentence,
)
from heartfit.results.figures import ARTERY, CALIBRATED, MEASURED, REFERENCE, clean
from heartfit.results.residual import CURVE_LABELS, PHASE_LABELS
from heartfit.results.text import printed_curve_unit

RANKING_BARS = 8
"""Number of bars of the ranking."""
MARKED_SAMPLES = 50
"""Largest number of samples with a large marker each."""


def plot_cause(diagnosis: Diagnosis) -> Figure:
    """Plot one row per curve: measured and simulated, and the misfit of the simulation in units of the noise.

    Both over the phases of the beat; the discrepancy has its 95 % band, and the phase of its largest departure is
    shaded and named; a blue band is what structure lets the simulation err. Bars: ln Bayes factors over baseline with
    the detection threshold (dashed). Of an unknown effect a last row shows the function at its place, with its 95 %
    band, and its best law (dashed).
    """
    rows = len(diagnosis.traces)
    figure = Figure(figsize=(12.5, 1.4 + 2.6 * (rows + bool(diagnosis.functions))), layout="constrained")
    above = figure
    if diagnosis.functions:
        above, below = figure.subfigures(2, 1, squeeze=False, height_ratios=(rows, 1.2))[:, 0]
        plot_functions(below, diagnosis)
    left, right = above.subfigures(1, 2, squeeze=False, width_ratios=(3.1, 1))[0]
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
    title = [verdict_sentence(diagnosis)]
    title += [f"Candidate, not named: {candidate_names(diagnosis)}."] if diagnosis.candidate else []
    figure.suptitle("\n".join(title), fontsize=11, fontweight="bold", wrap=True)
    return figure


def _curves(axes: Axes, trace: Trace, diagnosis: Diagnosis) -> None:
    unit, size = printed_curve_unit(trace.curve)
    factor = 1.0 / size
    order, times = _in_one_beat(trace.times, diagnosis.period)
    axes.plot(times, factor * trace.measured[order], "o", color=MEASURED, markersize=2.8, label="measured")
    axes.plot(times, factor * trace.none[order], "--", color=ARTERY, linewidth=1.4, label="simulated")
    label = _extension(diagnosis)
    if label:
        extended = factor * trace.extended[order]
        axes.plot(times, extended, color=CALIBRATED, linewidth=1.4, label=label)
    axes.set_ylabel(f"{CURVES.get(trace.curve, trace.curve)}\n({unit})", fontsize=9)
    _phases(axes, diagnosis.phases)
    clean(axes)


def _extension(diagnosis: Diagnosis) -> str:
    """Return what the extended simulation has, as label; empty where none is shown."""
    labels = {
        "with the mechanism": diagnosis.mechanisms,
        "with the free function": diagnosis.acting,
        "with the candidate, not named": diagnosis.candidate,
    }
    return next((label for label, shown in labels.items() if shown), "")


def _residuals(axes: Axes, trace: Trace, diagnosis: Diagnosis, departure: Departure) -> None:
    order, times = _in_one_beat(trace.times, diagnosis.period)
    noise = trace.noise[order]
    lacking = -trace.lacking[order] / noise
    axes.axhline(0.0, color="black", linewidth=0.6)
    low, high = ((side * 2.0 * trace.band - trace.lacking)[order] / noise for side in (-1.0, 1.0))
    axes.fill_between(times, low, high, color=REFERENCE, alpha=0.35, linewidth=0)
    if trace.structure is not None and trace.structure.any():
        allowed = 2.0 * (trace.structure / trace.noise)[order]
        axes.fill_between(
            times, -allowed, allowed, color=ARTERY, alpha=0.12, linewidth=0, label="structure, 95 % band"
        )
    mark = "o" if times.size < MARKED_SAMPLES else "."
    misfit = (trace.none - trace.measured)[order] / noise
    axes.plot(times, misfit, mark, color=ARTERY, markersize=3)
    axes.plot(
        times, -trace.lacking[order] / noise, color=MEASURED, linewidth=1.4, label="discrepancy, 95 % band"
    )
    if _extension(diagnosis):
        explained = (trace.extended - trace.measured)[order] / noise
        axes.plot(times, explained, mark, color=CALIBRATED, markersize=3)
    reach = 1.25 * max(2.0 * CLEAR_DEVIATIONS, *np.abs([*misfit, *lacking]))
    axes.set_ylim(-reach, reach)
    axes.set_ylabel("simulated − measured\n(units of noise)", fontsize=9)
    _phases(axes, diagnosis.phases)
    _mark(axes, departure, diagnosis)
    clean(axes)


def _mark(axes: Axes, departure: Departure, diagnosis: Diagnosis) -> None:
    """Set the departure as title, and shade its phase."""
    name, phases = CURVE_LABELS.get(departure.curve, departure.curve), diagnosis.phases
    name += " (not searched)" if departure.curve in diagnosis.unsearched else ""
    if not departure.clear:
        axes.set_title(f"{name}: no misfit beyond the noise", fontsize=10, pad=24)
        return
    title = f"{name} {direction_and_phase(departure)}: {abs(departure.deviations):.1f} sd"
    axes.set_title(title, fontsize=10, fontweight="bold", color=CALIBRATED, pad=24)
    for phase, start, end in [] if phases is None else phases.spans():
        if phase == departure.phase:
            axes.axvspan(start, end, color=CALIBRATED, alpha=0.12, linewidth=0)


def _phases(axes: Axes, phases: BeatPhases | None) -> None:
    """Draw the start of each phase of the beat, and its name if it fits."""
    for name, start, end in [] if phases is None else phases.spans():
        axes.axvline(start, color="black", linewidth=0.5, linestyle=":")
        if phases is not None and end - start > 0.04 * phases.period:
            middle, above = 0.5 * (start + end), axes.get_xaxis_transform()
            label = PHASE_LABELS.get(name, name)
            axes.text(middle, 1.01, label, transform=above, ha="center", va="bottom", fontsize=7)


def _in_one_beat(times: Floats, period: float) -> tuple[np.ndarray, Floats]:
    """Return the order of the samples by their phase, and the times in that order."""
    inside = np.mod(times, period)
    order = np.argsort(inside, kind="stable")
    return order, inside[order]


def _ranking(axes: Axes, diagnosis: Diagnosis) -> None:
    shown = list(diagnosis.ranking.items())[:RANKING_BARS][::-1]
    named = {cause.name for cause in diagnosis.mechanisms} or {diagnosis.verdict}
    colours = [CALIBRATED if name in named else REFERENCE for name, _ in shown]
    axes.barh(range(len(shown)), [max(value, 0.0) for _, value in shown], color=colours)
    axes.set_yticks(range(len(shown)), [spaced_name(name) for name, _ in shown], fontsize=8)
    axes.axvline(diagnosis.threshold, color="black", linewidth=0.8, linestyle="--")
    axes.set_xlabel("ln Bayes factor\nover baseline", fontsize=9)
    axes.set_xlim(0.0, max(1.3 * diagnosis.threshold, 1.05 * max((value for _, value in shown), default=0.0)))
    clean(axes)


@dataclass(frozen=True, eq=False)
class RenderedCause:
    """A diagnosis with its departures (one sentence per curve), its card (Markdown) and its figure."""

    diagnosis: Diagnosis
    misses: tuple[str, ...]
    card: str
    figure: Figure


def render_cause(diagnosis: Diagnosis, title: str) -> RenderedCause:
    """Return the content of the folder of a cause card; ``title`` is the heading of the card."""
    return RenderedCause(
        diagnosis, departure_sentences(diagnosis), markdown_card(diagnosis, title), plot_cause(diagnosis)
    )
