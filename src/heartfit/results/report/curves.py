"""Volume, pressure and loop of both ventricles of a case: measured with noise, calibrated with posterior band."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.observation.residual import unbiased_with_noise
from heartfit.results.card import INTERVAL_REACH
from heartfit.results.figures import MEASURED, REFERENCE, clean, shift_curves
from heartfit.results.report.picture import (
    TEXT,
    Picture,
    as_picture,
    dot_track,
    fix_layout,
    legend,
    time_line_track,
)
from heartfit.results.report.record import CaseRecord, Curves

KINDS = {"volume": ("volume (mL)", 1e6), "pressure": ("pressure (kPa)", 1e-3)}
SIDES = {"lv": "left ventricle", "rv": "right ventricle"}
MARKED_SAMPLES = 60
"""Largest number of samples with a marker each."""


def plot_curves(case: CaseRecord, colours: Mapping[str, str]) -> Picture:
    """Plot volume, pressure and loop, one row per ventricle, with simulated times shifted to the measured ones.

    Bands contain 95 %: of the noise about a measured curve (grey), and of the posterior about a calibrated one.
    colours: of the settings.
    """
    with rc_context(TEXT):
        figure = Figure(figsize=(11, 6.1), layout="constrained")
        axes = figure.subplots(2, 3)
        for row, side in zip(axes, SIDES, strict=True):
            for panel, kind in zip(row, KINDS, strict=False):
                _over_time(panel, case, f"{side}_{kind}", colours)
            _loop(row[2], case, side, colours)
        legend(figure, [axes[0, 0]])
        fix_layout(figure)
        return as_picture(
            figure, f"Volumes, pressures and loops of {case.name}", _time_tracks(axes, case, colours)
        )


def simulated(case: CaseRecord, colours: Mapping[str, str]) -> Iterator[tuple[str, Curves, Curves, str, str]]:
    """Yield label, curves, bands, colour and style of each beat at measured times, the prior first."""
    fits = list(case.fits.values())
    yield "prior mean", shift_curves(fits[-1].reference, fits[-1].shift), {}, REFERENCE, "--"
    for name, fit in case.fits.items():
        label = f"calibrated, {name}" if fit.completed else f"{name}: beat failed"
        yield (
            label,
            shift_curves(fit.calibrated, fit.shift),
            shift_curves(fit.band, fit.shift),
            colours[name],
            "-",
        )


def samples(curves: Curves, name: str, factor: float) -> tuple[Floats, Floats]:
    """Return times [s] and values in the printed unit of a curve, empty for a missing curve."""
    curve = curves.get(name)
    return (np.empty(0), np.empty(0)) if curve is None else (curve.times, factor * curve.values)


def _over_time(axes: Axes, case: CaseRecord, name: str, colours: Mapping[str, str]) -> None:
    side, kind = name.split("_")
    label, factor = KINDS[kind]
    _measured(axes, case, name, factor)
    for beat, curves, bands, shade, style in simulated(case, colours):
        times, values = samples(curves, name, factor)
        axes.plot(times, values, linestyle=style, color=shade, linewidth=1.6, label=beat)
        if name in bands:
            reach = INTERVAL_REACH * factor * bands[name].values
            axes.fill_between(times, values - reach, values + reach, color=shade, alpha=0.18, linewidth=0)
    axes.set(title=f"{SIDES[side]}: {kind}", xlabel="time after trigger (s)", ylabel=label)
    axes.set_xlim(0.0, case.registered.period)
    clean(axes)


def _measured(axes: Axes, case: CaseRecord, name: str, factor: float) -> None:
    if name not in case.measured:
        axes.text(0.98, 0.96, "not measured", transform=axes.transAxes, ha="right", va="top", color="#555555")
        return
    curve, noise = unbiased_with_noise(name, case.measured[name], case.noise)
    middle, reach = factor * curve.values, INTERVAL_REACH * factor * noise
    axes.fill_between(curve.times, middle - reach, middle + reach, color="#d0d0d0", linewidth=0)
    few = len(case.measured[name].times) < MARKED_SAMPLES
    mark: Any = {"marker": "o", "linestyle": "none"} if few else {"marker": "", "linestyle": "-"}
    axes.plot(*samples(case.measured, name, factor), color=MEASURED, markersize=3.2, label="measured", **mark)


def _loop(axes: Axes, case: CaseRecord, side: str, colours: Mapping[str, str]) -> None:
    beats = [("", case.measured, {}, MEASURED, "-"), *simulated(case, colours)]
    for _, curves, _, shade, style in beats:
        loop = _loop_points(curves, side, curves[f"{side}_volume"].times) if _has_loop(curves, side) else None
        if loop is not None:
            axes.plot(*np.vstack([loop, loop[:1]]).T, linestyle=style, color=shade, linewidth=1.5)
    axes.set(title=f"{SIDES[side]}: loop", xlabel="volume (mL)", ylabel="pressure (kPa)")
    clean(axes)


def _has_loop(curves: Curves, side: str) -> bool:
    return {f"{side}_volume", f"{side}_pressure"} <= set(curves)


def _loop_points(curves: Curves, side: str, times: Floats) -> Floats:
    """Return volume [mL] and pressure [kPa] (p, 2) at times [s]."""
    return np.column_stack([factor * curves[f"{side}_{kind}"](times) for kind, (_, factor) in KINDS.items()])


def _time_tracks(axes: np.ndarray, case: CaseRecord, colours: Mapping[str, str]) -> list[dict[str, Any]]:
    """Return tracks of a time line in the panels over time and of a dot on each loop, at the phases of the motion."""
    times = case.registered.times
    lines = [time_line_track(panel, times) for panel in axes[:, :2].flat]
    shown = ((curves, shade) for _, curves, _, shade, _ in simulated(case, colours))
    beats = [(case.measured, MEASURED), *shown]
    dots = [
        dot_track(panel, _loop_points(curves, side, times), shade)
        for panel, side in zip(axes[:, 2], SIDES, strict=True)
        for curves, shade in beats
        if _has_loop(curves, side) and shade != REFERENCE
    ]
    return [*lines, *dots]
