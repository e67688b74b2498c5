"""Fig. 3 (right) of the paper, for one case: measured, reference and calibrated beat of both ventricles."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.calibration.update import Posterior
from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures
from heartfit.tables.text import symbol

# Okabe and Ito's colours, told apart by colour-blind readers and in grey
MEASURED, REFERENCE, CALIBRATED, ATRIUM, ARTERY = "#000000", "#999999", "#D55E00", "#009E73", "#0072B2"
SIDES = {
    "lv": ("left ventricle", "left_atrium", "aorta"),
    "rv": ("right ventricle", "right_atrium", "pulmonary_artery"),
}
STYLE: dict[str, dict[str, Any]] = {
    "measured": {"color": MEASURED, "marker": "o", "markersize": 3.5, "linestyle": "none"},
    "reference": {"color": REFERENCE, "linestyle": "--", "linewidth": 1.4},
    "calibrated": {"color": CALIBRATED, "linestyle": "-", "linewidth": 1.8},
}
Curves = Mapping[str, Curve]


def plot_case(
    curves: Mapping[str, Curves], title: str, operator: CurveFeatures, shift: float = 0.0
) -> Figure:
    """Volume, flow, pressure and pressure-volume loop of both ventricles, one row each.

    curves: "measured", "reference" (prior X0) and "calibrated", time zero at the trigger; a beat that failed
    is left out. Flows are taken by the observation operator, so that simulation and measurement are
    comparable. shift (s): the simulated time of measured time zero, subtracted from the simulated times; NaN
    if none was found.
    """
    figure = Figure(figsize=(13, 6), layout="constrained")
    axes = figure.subplots(2, 4)
    start = shift if np.isfinite(shift) else 0.0
    shifted = {name: moved(group, 0.0 if name == "measured" else start) for name, group in curves.items()}
    for row, (side, (label, atrium, artery)) in zip(axes, SIDES.items(), strict=True):
        _volumes(row[0], shifted, side, label)
        _flows(row[1], shifted, side, operator)
        _pressures(row[2], shifted, side, (atrium, artery))
        _loops(row[3], shifted, side)
    for panel in (axes[0, 0], axes[0, 2]):
        if panel.get_legend_handles_labels()[0]:
            panel.legend(frameon=False, fontsize=8)
    figure.suptitle(
        title + (f" (simulated trigger moved by {1e3 * start:+.0f} ms)" if start else ""), fontsize=11
    )
    return figure


def plot_sensitivity(posterior: Posterior, title: str) -> Figure:
    """Bars of the normalised Cov(X, Z): which parameter moves which observation, and the singular values."""
    figure = Figure(figsize=(6.5, 3.2), layout="constrained")
    axes = figure.subplots()
    count = len(posterior.prior.names)
    places = np.arange(len(posterior.observations))
    for index, name in enumerate(posterior.prior.names):
        offset = (index - (count - 1) / 2) * 0.8 / count
        axes.bar(
            places + offset,
            posterior.sensitivity[index],
            0.75 / count,
            label=symbol(name),
            color=colour(index),
        )
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set_xticks(places, [symbol(name) for name in posterior.observations])
    axes.set_ylabel("normalised covariance")
    values = ", ".join(f"{value:.2f}" for value in posterior.singular_values)
    axes.set_title(f"{title}; singular values {values}", fontsize=10)
    axes.legend(frameon=False, ncols=count, fontsize=9)
    clean(axes)
    return figure


def _volumes(axes: Axes, curves: Mapping[str, Curves], side: str, label: str) -> None:
    for name, group in curves.items():
        curve = group.get(f"{side}_volume")
        if curve is not None:
            axes.plot(curve.times, 1e6 * curve.values, label=name, **STYLE[name])
    _label(axes, "time after trigger (s)", "volume (mL)", label)


def _flows(axes: Axes, curves: Mapping[str, Curves], side: str, operator: CurveFeatures) -> None:
    for name, group in curves.items():
        if f"{side}_volume" in group:
            rate = operator.rate(group[f"{side}_volume"])
            axes.plot(rate.times, 1e6 * rate.values, **STYLE[name])
    axes.axhline(0, color="black", linewidth=0.6)
    _label(axes, "time after trigger (s)", "dV/dt (mL/s)", f"{operator.frames} frames")


def _pressures(axes: Axes, curves: Mapping[str, Curves], side: str, neighbours: tuple[str, str]) -> None:
    for name, group in curves.items():
        curve = group.get(f"{side}_pressure")
        if curve is not None:
            axes.plot(curve.times, 1e-3 * curve.values, **STYLE[name])
    for place, colour in zip(neighbours, (ATRIUM, ARTERY), strict=True):
        curve = curves.get("calibrated", {}).get(f"{place}_pressure")
        if curve is not None:
            label = {"aorta": "artery", "left_atrium": "atrium"}.get(place)
            axes.plot(curve.times, 1e-3 * curve.values, color=colour, linewidth=1.1, label=label)
    _label(axes, "time after trigger (s)", "pressure (kPa)", "calibrated, with its neighbours")


def _loops(axes: Axes, curves: Mapping[str, Curves], side: str) -> None:
    for name, group in curves.items():
        if {f"{side}_volume", f"{side}_pressure"} <= set(group):
            volume = group[f"{side}_volume"]
            closed = np.append(np.arange(volume.times.size), 0)
            pressure = group[f"{side}_pressure"](volume.times)
            axes.plot(1e6 * volume.values[closed], 1e-3 * pressure[closed], **STYLE[name])
    _label(axes, "volume (mL)", "pressure (kPa)", "loop")


def moved(group: Curves, shift: float) -> dict[str, Curve]:
    """Curves with their samples in [0, period) after the shift, so that lines run from left to right."""
    return {name: _wrapped(curve.shifted(shift)) for name, curve in group.items()}


def _wrapped(curve: Curve) -> Curve:
    times = curve.times % curve.period
    order = np.argsort(times)
    return Curve(times[order], curve.values[order], curve.period)


def _label(axes: Axes, x: str, y: str, title: str) -> None:
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.set_title(title, fontsize=9)
    clean(axes)


def clean(axes: Axes) -> None:
    """Leaves two of the four spines."""
    axes.spines[["top", "right"]].set_visible(False)


def colour(index: int) -> str:
    """Okabe and Ito's colours, in an order that suits lines."""
    return ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")[index % 7]
