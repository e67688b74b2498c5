"""Cause card as a figure."""

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.cause import Diagnosis, Trace
from heartfit.discovery.sphere_model.misfit import Departure, departures, phase_names
from heartfit.observation.beat import BeatPhases
from heartfit.results.acting_figure import plot_functions
from heartfit.results.cause_card import markdown_card
from heartfit.results.figures import ARTERY, CALIBRATED, MEASURED, REFERENCE, clean
from heartfit.results.misfit_text import added_name, mean_misfit, misfit_sentences
from heartfit.results.residual import CURVE_LABELS, PHASE_LABELS
from heartfit.results.text import CURVES, printed_curve_unit
from heartfit.results.verdict_text import candidate_names, explanation_name, verdict_sentence

RANKING_BARS = 8
"""Number of bars of the ranking."""
MARKED_SAMPLES = 50
"""Largest number of samples with a large marker each."""


def plot_cause(diagnosis: Diagnosis) -> Figure:
    """Plot one row per curve: measured and simulated, and the residuals of the simulations with the noise.

    Both over the phases of the beat. A bar is the mean residual of a phase; the title tells that of the simulation
    without a cause which is clearest relative to its noise, and its phase is shaded where it exceeds it. A blue band is
    what structure lets the simulation err; of an unknown effect without a place, a black line is the smooth error that
    explains more than the library does, which is no residual. Bars on the right: ln Bayes factors over no mechanism,
    with the detection threshold (dashed). Of an unknown effect a last row shows the function at its place, with its
    95 % band, and its best law (dashed).
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
        _residuals(row[1], trace, diagnosis)
        _mark(row[1], departure, diagnosis)
    for axes in panels[-1]:
        axes.set_xlabel("time after trigger (s)")
        axes.set_xlim(0.0, diagnosis.period)
    for axes in panels[0]:
        axes.legend(frameon=False, fontsize=8, loc="best")
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
    label = f"{diagnosis.model}, no mechanism"
    axes.plot(times, factor * trace.none[order], "--", color=ARTERY, linewidth=1.4, label=label)
    if added_name(diagnosis):
        extended, label = factor * trace.extended[order], f"with {added_name(diagnosis)}"
        axes.plot(times, extended, color=CALIBRATED, linewidth=1.4, label=label)
    axes.set_ylabel(f"{CURVES.get(trace.curve, trace.curve)}\n({unit})", fontsize=9)
    _phases(axes, diagnosis.phases)
    clean(axes)


def _residuals(axes: Axes, trace: Trace, diagnosis: Diagnosis) -> None:
    unit, size = printed_curve_unit(trace.curve)
    order, times = _in_one_beat(trace.times, diagnosis.period)
    reach = 2.0 * trace.noise[order] / size
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.fill_between(
        times, -reach, reach, color=REFERENCE, alpha=0.3, linewidth=0, label="noise of a sample, 95 %"
    )
    if trace.structure is not None and trace.structure.any():
        allowed = 2.0 * trace.structure[order] / size
        axes.fill_between(
            times, -allowed, allowed, color=ARTERY, alpha=0.12, linewidth=0, label="structure, 95 % band"
        )
    simulations = {ARTERY: trace.none} | ({CALIBRATED: trace.extended} if added_name(diagnosis) else {})
    shown = [reach]
    for shade, simulated in simulations.items():
        residual = (simulated - trace.measured)[order] / size
        mark = "o" if times.size < MARKED_SAMPLES else "."
        axes.plot(times, residual, mark, color=shade, markersize=3)
        _means(axes, times, residual, diagnosis, shade)
        shown.append(np.abs(residual))
    detected = diagnosis.verdict == "unknown" and not diagnosis.acting
    if detected and trace.lacking is not None and trace.band is not None:
        smooth, sd = -trace.lacking[order] / size, trace.band[order] / size
        axes.plot(
            times, smooth, color=MEASURED, linewidth=1.2, label="smooth error fitted with it, 95 % band"
        )
        low, high = smooth - 2.0 * sd, smooth + 2.0 * sd
        axes.fill_between(times, low, high, color=MEASURED, alpha=0.08, linewidth=0)
        shown.append(np.abs(smooth))
    most = 1.25 * float(np.concatenate(shown).max())
    axes.set_ylim(-most, most)
    axes.set_ylabel(f"simulated − measured\n({unit})", fontsize=9)
    _phases(axes, diagnosis.phases)
    clean(axes)


def _means(axes: Axes, times: Floats, residual: Floats, diagnosis: Diagnosis, shade: str) -> None:
    """Draw the mean of the residuals in each phase as a bar from its first to its last sample."""
    names = phase_names(times, diagnosis.period, diagnosis.phases)
    label = "mean of a phase" if shade == ARTERY else "_"
    for place, name in enumerate(dict.fromkeys(names.tolist())):
        inside = names == name
        runs = np.split(times[inside], np.flatnonzero(np.diff(np.flatnonzero(inside)) > 1) + 1)
        lows, highs = [run[0] for run in runs], [run[-1] for run in runs]
        mean = np.full(len(runs), residual[inside].mean())
        axes.hlines(
            mean,
            lows,
            highs,
            color=shade,
            linewidth=2.4,
            capstyle="round",
            label=label if place == 0 else "_",
        )


def _mark(axes: Axes, departure: Departure, diagnosis: Diagnosis) -> None:
    """Set the departure of the simulation without a cause as title, and shade its phase."""
    name, phases = CURVE_LABELS.get(departure.curve, departure.curve), diagnosis.phases
    name += " (not searched)" if departure.curve in diagnosis.unsearched else ""
    size = f"{mean_misfit(departure)}: {abs(departure.deviations):.1f} sd"
    if not departure.clear:
        axes.set_title(
            f"{name} without a mechanism: no mean beyond the noise\n(at most {size})", fontsize=9, pad=24
        )
        return
    title = f"{name} without a mechanism:\n{size}"
    axes.set_title(title, fontsize=9, fontweight="bold", color=ARTERY, pad=24)
    for phase, start, end in [] if phases is None else phases.spans():
        if phase == departure.phase:
            axes.axvspan(start, end, color=ARTERY, alpha=0.08, linewidth=0)


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
    axes.set_yticks(range(len(shown)), [explanation_name(name) for name, _ in shown], fontsize=8)
    axes.axvline(diagnosis.threshold, color="black", linewidth=0.8, linestyle="--")
    axes.set_xlabel(
        f"ln Bayes factor\nover no mechanism\n(dashed: threshold {diagnosis.threshold:g})", fontsize=9
    )
    axes.set_xlim(0.0, max(1.3 * diagnosis.threshold, 1.05 * max((value for _, value in shown), default=0.0)))
    clean(axes)


@dataclass(frozen=True, eq=False)
class RenderedCause:
    """A diagnosis with the sentences on its misfit, its card (Markdown) and its figure."""

    diagnosis: Diagnosis
    misses: tuple[str, ...]
    card: str
    figure: Figure


def render_cause(diagnosis: Diagnosis, title: str) -> RenderedCause:
    """Return the content of the folder of a cause card; ``title`` is the heading of the card."""
    return RenderedCause(
        diagnosis, misfit_sentences(diagnosis), markdown_card(diagnosis, title), plot_cause(diagnosis)
    )
