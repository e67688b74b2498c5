"""A measured heart without and with the mechanisms that lead: errors on held-out samples and filling indices."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.refit.target import fitted_mask
from heartfit.discovery.sphere_model.cause import Diagnosis, Gain, Trace
from heartfit.observation.curve import Curve
from heartfit.observation.filling import volume_indices
from heartfit.results.figures import CALIBRATED, MEASURED, REFERENCE, clean
from heartfit.results.text import spaced_name
from heartfit.results.verdict_text import candidate_names

MILLILITRE, MILLISECOND, PERCENT = 1e-6, 1e-3, 1e-2
SIDES = {"lv_volume": "left ventricle", "rv_volume": "right ventricle"}
INDICES = {
    "dip": ("fall of the volume in diastasis (mL)", MILLILITRE),
    "E": ("early filling, peak flow E (mL/s)", MILLILITRE),
    "A": ("atrial filling, peak flow A (mL/s)", MILLILITRE),
    "time of E": ("time of E (ms)", MILLISECOND),
    "time of A": ("time of A (ms)", MILLISECOND),
}
"""Printed name and unit of the filling indices that a volume gives."""
READINGS = ("surface alone", "blood of the slices alone")
"""Names of the first and the second reading of a left volume."""
COLUMNS = ("measured", "without", "with")


def extension_table(diagnosis: Diagnosis, readings: Sequence[Curve] = ()) -> pd.DataFrame:
    """Return one row per quantity: measured, and of the refitted heart without and with the mechanisms.

    Errors are root mean squares over the samples that neither search nor refit used, of the left volume also against
    each of its ``readings`` alone if there are two. Filling indices are read from the frames of the volume, as they are
    measured. They are empty where a volume has no two waves.
    """
    rows = [_error_row(gain) for gain in diagnosis.gain]
    left = _trace(diagnosis, "lv_volume")
    named = zip(READINGS, readings, strict=True) if len(readings) > 1 else ()
    rows += [_reading_row(name, curve, left) for name, curve in named]
    rows += _index_rows(left, diagnosis.period)
    return pd.DataFrame(rows)


def _error_row(gain: Gain) -> dict[str, Any]:
    name, scale = (
        (f"{gain.curve}, error (%)", PERCENT)
        if gain.curve.endswith("strain")
        else (f"{SIDES.get(gain.curve, gain.curve)}, volume error (mL)", MILLILITRE)
    )
    low, high = gain.interval
    return {
        "quantity": f"{name}: {gain.on}",
        "measured": "",
        "without": f"{gain.none / scale:.2f}",
        "with": f"{gain.extended / scale:.2f}",
        "ratio": f"{gain.ratio:.2f} ({low:.2f} to {high:.2f})",
    }


def unseen(trace: Trace) -> np.ndarray:
    """Mask (k,) of the frames that neither search nor refit used."""
    return ~fitted_mask(trace.times.size)


def _reading_row(name: str, reading: Curve, trace: Trace) -> dict[str, Any]:
    held = unseen(trace)
    errors = [_root_mean_square((reading.values - fit)[held]) for fit in (trace.none, trace.extended)]
    return {
        "quantity": f"left ventricle, volume error (mL): the same frames, {name}",
        "measured": "",
        "without": f"{errors[0] / MILLILITRE:.2f}",
        "with": f"{errors[1] / MILLILITRE:.2f}",
        "ratio": f"{errors[1] / errors[0]:.2f}",
    }


def _root_mean_square(error: Floats) -> float:
    return float(np.sqrt(np.mean(error**2)))


def _index_rows(trace: Trace, period: float) -> list[dict[str, Any]]:
    courses = (trace.measured, trace.none, trace.extended)
    columns = [_indices(Curve(trace.times, values, period)) for values in courses]
    return [
        {"quantity": label}
        | {
            heading: f"{indices[name] / scale:.0f}" if name in indices else ""
            for heading, indices in zip(COLUMNS, columns, strict=True)
        }
        | {"ratio": ""}
        for name, (label, scale) in INDICES.items()
    ]


def _indices(volume: Curve) -> Mapping[str, float]:
    try:
        return volume_indices(volume)
    except InputError:
        return {}


def _trace(diagnosis: Diagnosis, name: str) -> Trace:
    return next(trace for trace in diagnosis.traces if trace.curve == name)


def plot_extension(diagnosis: Diagnosis, title: str) -> Figure:
    """Plot volume, flow and error of each ventricle, measured, without and with the mechanisms.

    Filled circles are frames that search and refit used, open ones frames that they did not; the band is the noise.
    """
    traces = [trace for trace in diagnosis.traces if trace.curve in SIDES]
    figure = Figure(figsize=(13, 3.2 * len(traces)), layout="constrained")
    rows = figure.subplots(len(traces), 3, squeeze=False)
    for axes, trace in zip(rows, traces, strict=True):
        _volume_panel(axes[0], trace)
        _flow_panel(axes[1], trace, diagnosis.period)
        _error_panel(axes[2], trace)
    rows[0, 0].legend(frameon=False, fontsize=8)
    for panel in rows[-1]:
        panel.set_xlabel("time after the trigger (ms)")
    named = " and ".join(spaced_name(cause.name) for cause in diagnosis.mechanisms)
    candidate = f"{candidate_names(diagnosis)} (candidate, not named)" if diagnosis.candidate else ""
    figure.suptitle(
        f"{title}: the heart without and with {named or candidate or 'the best of the ranking'}", fontsize=11
    )
    return figure


LINES = {"none": ("without", REFERENCE, "--"), "extended": ("with", CALIBRATED, "-")}


def _volume_panel(axes: Axes, trace: Trace) -> None:
    times, held = trace.times / MILLISECOND, unseen(trace)
    for name, (label, colour, style) in LINES.items():
        axes.plot(times, getattr(trace, name) / MILLILITRE, style, color=colour, label=label)
    measured = trace.measured / MILLILITRE
    axes.plot(times[~held], measured[~held], "o", color=MEASURED, markersize=4, label="measured, fitted")
    axes.plot(
        times[held],
        measured[held],
        "o",
        color=MEASURED,
        markersize=4,
        markerfacecolor="white",
        label="not fitted",
    )
    axes.set_ylabel(f"{SIDES[trace.curve]}, volume (mL)")
    clean(axes)


def _flow_panel(axes: Axes, trace: Trace, period: float) -> None:
    for name, (_, colour, style) in LINES.items():
        axes.plot(*_flow(trace.times, getattr(trace, name), period), style, color=colour)
    axes.plot(*_flow(trace.times, trace.measured, period), "o", color=MEASURED, markersize=4)
    axes.axhline(0.0, color=REFERENCE, linewidth=0.6)
    axes.set_ylabel("its rate (mL/s)")
    clean(axes)


def _flow(times: Floats, values: Floats, period: float) -> tuple[Floats, Floats]:
    """Times [ms] and central differences [mL/s] of a periodic volume."""
    spans = np.mod(np.roll(times, -1) - np.roll(times, 1), period)
    return times / MILLISECOND, (np.roll(values, -1) - np.roll(values, 1)) / spans / MILLILITRE


def _error_panel(axes: Axes, trace: Trace) -> None:
    times = trace.times / MILLISECOND
    noise = trace.noise / MILLILITRE
    axes.fill_between(times, -noise, noise, color=REFERENCE, alpha=0.25, linewidth=0.0)
    for name, (_, colour, style) in LINES.items():
        axes.plot(
            times, (getattr(trace, name) - trace.measured) / MILLILITRE, style, color=colour, marker="."
        )
    axes.set_ylabel("simulated less measured (mL)")
    clean(axes)
