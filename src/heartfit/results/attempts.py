"""Gains in held-out error by mechanisms that were refitted without being named."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.discovery.sphere_model.cause import Attempt, Gain, Trace
from heartfit.results.figures import ARTERY, CALIBRATED, MEASURED, REFERENCE, clean
from heartfit.results.text import AMPLITUDE_UNITS, printed_ratio, spaced_name

GAIN_LABELS = {
    "lv_volume": "LV volume, other frames",
    "lv_pressure": "LV pressure, other 40 ms",
    "rv_volume": "RV volume",
    "circumferential strain": "circumferential strain",
    "longitudinal strain": "longitudinal strain",
}


def sort_by_gain(attempts: Sequence[Attempt]) -> list[Attempt]:
    """Return the attempts in order of their error of the held-out left ventricular volume, the best first."""
    return sorted(attempts, key=lambda attempt: gains_by_curve(attempt)["lv_volume"].ratio)


def gains_by_curve(attempt: Attempt) -> Mapping[str, Gain]:
    """Return the gains of an attempt by held-out curve."""
    return {gain.curve: gain for gain in attempt.gain}


def attempts_table(attempts: Sequence[Attempt]) -> pd.DataFrame:
    """Return one row per mechanism: size, evidence of the refits, and error ratios, below one for a gain."""
    return pd.DataFrame([_attempt_row(attempt) for attempt in sort_by_gain(attempts)])


def _attempt_row(attempt: Attempt) -> dict[str, str | float]:
    (size,) = attempt.refitted.extension
    unit, factor = AMPLITUDE_UNITS.get(size.unit, (size.unit, 1.0))
    values = [f"{factor * value:.3g}" for value in (size.amplitude, *size.interval)]
    return {
        "mechanism": spaced_name(size.name),
        "size": f"{values[0]} ({values[1]} to {values[2]}) {unit}".strip(),
        "ln BF": f"{attempt.refitted.ln_bayes_factor:.1f}",
        **{GAIN_LABELS[gain.curve]: printed_ratio(gain.ratio, gain.interval) for gain in attempt.gain},
        "at rest": "yes" if attempt.refitted.converged else "no",
        "beats": attempt.refitted.simulations,
    }


DRAWN_MECHANISMS = 2
"""Number of mechanisms with a drawn volume."""
STYLES = ((CALIBRATED, "-"), (ARTERY, "--"))


def plot_attempts(attempts: Sequence[Attempt], title: str) -> Figure:
    """Plot the left volume with and without the best mechanisms, and the error ratios of all with 95 % intervals.

    Filled circles in the first panel are fitted frames, open circles held-out frames.
    """
    ordered = sort_by_gain(attempts)
    curves = list(gains_by_curve(ordered[0]))
    figure = Figure(
        figsize=(4.2 + 2.0 * len(curves), 1.9 + 0.32 * max(len(ordered), 6)), layout="constrained"
    )
    left, right = figure.subfigures(1, 2, squeeze=False, width_ratios=(4.2, 2.2 * len(curves)))[0]
    _volumes(left.subplots(), ordered[:DRAWN_MECHANISMS])
    panels = right.subplots(1, len(curves), sharey=True, squeeze=False)[0]
    for axes, curve in zip(panels, curves, strict=True):
        _ratios(axes, ordered, curve)
    panels[0].set_yticks(
        range(len(ordered)), [spaced_name(_mechanism_name(attempt)) for attempt in ordered], fontsize=8.5
    )
    panels[0].invert_yaxis()
    right.supxlabel(
        "held-out error with the mechanism over error without it, 95 % CI; gain below 1", fontsize=9
    )
    figure.suptitle(f"{title}: gain in held-out error by each mechanism", fontsize=11)
    return figure


def _mechanism_name(attempt: Attempt) -> str:
    return attempt.refitted.extension[0].name


def _lv_trace(attempt: Attempt) -> Trace:
    return next(trace for trace in attempt.traces if trace.curve == "lv_volume")


def _volumes(axes: Axes, best: Sequence[Attempt]) -> None:
    trace = _lv_trace(best[0])
    fitted = np.arange(trace.times.size) % 2 == 0
    for frames, filled, label in (
        (fitted, MEASURED, "measured, fitted"),
        (~fitted, "white", "measured, held out"),
    ):
        axes.plot(
            trace.times[frames], 1e6 * trace.measured[frames], "o", color=MEASURED,
            markerfacecolor=filled, markersize=3.8, label=label, zorder=3,
        )  # fmt: skip
    axes.plot(trace.times, 1e6 * trace.none, ":", color=REFERENCE, linewidth=2.0, label="baseline")
    for attempt, (shade, line) in zip(best, STYLES, strict=False):
        extended = _lv_trace(attempt).extended
        axes.plot(
            trace.times,
            1e6 * extended,
            line,
            color=shade,
            linewidth=1.5,
            label=spaced_name(_mechanism_name(attempt)),
        )
    axes.set_xlabel("time after trigger (s)", fontsize=9)
    axes.set_ylabel("LV volume (mL)", fontsize=9)
    axes.legend(frameon=False, fontsize=8)
    clean(axes)


def _ratios(axes: Axes, attempts: Sequence[Attempt], curve: str) -> None:
    axes.axvline(1.0, color="black", linewidth=0.8, linestyle="--")
    for row, gain in enumerate(gains_by_curve(attempt)[curve] for attempt in attempts):
        shade = CALIBRATED if gain.interval[1] < 1.0 else ARTERY if gain.interval[0] > 1.0 else REFERENCE
        axes.plot(gain.interval, (row, row), color=shade, linewidth=1.6)
        axes.plot(gain.ratio, row, "o", color=shade, markersize=5)
    axes.set_title(GAIN_LABELS[curve].replace(", ", ",\n"), fontsize=9)
    axes.tick_params(labelsize=8)
    clean(axes)
