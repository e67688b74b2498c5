"""Volume, pressure and loop of both ventricles of one case: measured with its noise, calibrated with its posterior."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.geometry.arrays import Floats
from heartfit.observation.residual import with_noise
from heartfit.report.grid import legend
from heartfit.report.picture import TEXT, Picture, line_of_time, picture, rider, settle
from heartfit.report.record import CaseRecord, Curves
from heartfit.tables.figures import MEASURED, REFERENCE, clean, colour, moved

KINDS = {"volume": ("volume (mL)", 1e6), "pressure": ("pressure (kPa)", 1e-3)}
SIDES = {"lv": "left ventricle", "rv": "right ventricle"}
FEW = 60
"""Samples up to which each has a mark."""
REACH = 1.96


def plot_curves(case: CaseRecord) -> Picture:
    """Rows: ventricles; columns: volume, pressure, pressure over volume; simulated times moved to the measured ones.

    Bands hold 95 %: of the noise about a measured curve, grey, and of the posterior about a calibrated one.
    """
    with rc_context(TEXT):
        figure = Figure(figsize=(11, 6.1), layout="constrained")
        axes = figure.subplots(2, 3)
        for row, side in zip(axes, SIDES, strict=True):
            for panel, kind in zip(row, KINDS, strict=False):
                _over_time(panel, case, f"{side}_{kind}")
            _loop(row[2], case, side)
        legend(figure, [axes[0, 0]])
        settle(figure)
        return picture(figure, f"Volumes, pressures and loops of {case.name}", _follow(axes, case))


def simulated(case: CaseRecord) -> Iterator[tuple[str, Curves, Curves, str, str]]:
    """Label, curves, bands, colour and style of each beat, at measured times: the prior's, then each setting's."""
    fits = list(case.fits.values())
    yield "prior's mean", moved(fits[-1].reference, fits[-1].shift), {}, REFERENCE, "--"
    for place, (name, fit) in enumerate(case.fits.items()):
        label = f"calibrated, {name}" if fit.completed else f"{name}: beat failed"
        yield label, moved(fit.calibrated, fit.shift), moved(fit.band, fit.shift), colour(place), "-"


def samples(curves: Curves, name: str, factor: float) -> tuple[Floats, Floats]:
    """Times, s, and values over their printed unit of a curve, none if it is not there."""
    curve = curves.get(name)
    return (np.empty(0), np.empty(0)) if curve is None else (curve.times, factor * curve.values)


def _over_time(axes: Axes, case: CaseRecord, name: str) -> None:
    side, kind = name.split("_")
    label, factor = KINDS[kind]
    _measured(axes, case, name, factor)
    for said, curves, bands, shade, style in simulated(case):
        times, values = samples(curves, name, factor)
        axes.plot(times, values, linestyle=style, color=shade, linewidth=1.6, label=said)
        if name in bands:
            reach = REACH * factor * bands[name].values
            axes.fill_between(times, values - reach, values + reach, color=shade, alpha=0.18, linewidth=0)
    axes.set(title=f"{SIDES[side]}: {kind}", xlabel="time after trigger (s)", ylabel=label)
    axes.set_xlim(0.0, case.registered.period)
    clean(axes)


def _measured(axes: Axes, case: CaseRecord, name: str, factor: float) -> None:
    if name not in case.measured:
        axes.text(0.98, 0.96, "not measured", transform=axes.transAxes, ha="right", va="top", color="#555555")
        return
    curve, noise = with_noise(name, case.measured[name], case.noise)
    middle, reach = factor * curve.values, REACH * factor * noise
    axes.fill_between(curve.times, middle - reach, middle + reach, color="#d0d0d0", linewidth=0)
    few = len(case.measured[name].times) < FEW
    mark: Any = {"marker": "o", "linestyle": "none"} if few else {"marker": "", "linestyle": "-"}
    axes.plot(*samples(case.measured, name, factor), color=MEASURED, markersize=3.2, label="measured", **mark)


def _loop(axes: Axes, case: CaseRecord, side: str) -> None:
    beats = [("", case.measured, {}, MEASURED, "-"), *simulated(case)]
    for _, curves, _, shade, style in beats:
        loop = _points(curves, side, curves[f"{side}_volume"].times) if _has_loop(curves, side) else None
        if loop is not None:
            axes.plot(*np.vstack([loop, loop[:1]]).T, linestyle=style, color=shade, linewidth=1.5)
    axes.set(title=f"{SIDES[side]}: loop", xlabel="volume (mL)", ylabel="pressure (kPa)")
    clean(axes)


def _has_loop(curves: Curves, side: str) -> bool:
    return {f"{side}_volume", f"{side}_pressure"} <= set(curves)


def _points(curves: Curves, side: str, times: Floats) -> Floats:
    """Volume, mL, and pressure, kPa, (p, 2) at times in s."""
    return np.column_stack([factor * curves[f"{side}_{kind}"](times) for kind, (_, factor) in KINDS.items()])


def _follow(axes: np.ndarray, case: CaseRecord) -> list[dict[str, Any]]:
    """A line of time in the panels over time, a dot on each loop, at the phases of the motion."""
    times = case.registered.times
    lines = [line_of_time(panel, times) for panel in axes[:, :2].flat]
    beats = [(case.measured, MEASURED), *((curves, shade) for _, curves, _, shade, _ in simulated(case))]
    dots = [
        rider(panel, _points(curves, side, times), shade)
        for panel, side in zip(axes[:, 2], SIDES, strict=True)
        for curves, shade in beats
        if _has_loop(curves, side) and shade != REFERENCE
    ]
    return [*lines, *dots]
