"""Fig. 3 (right) of the paper for one case: measured, reference and calibrated beat of both ventricles."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.calibration.update import Posterior
from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures
from heartfit.results.text import symbol

# Okabe and Ito's colours, distinct for colour-blind readers and in grey
MEASURED, REFERENCE, CALIBRATED, ATRIUM, ARTERY = "#000000", "#999999", "#D55E00", "#009E73", "#0072B2"
SIDES = {
    "lv": ("left ventricle", "left_atrium", "aorta"),
    "rv": ("right ventricle", "right_atrium", "pulmonary_artery"),
}
"""Colours with one meaning; those of settings are in `heartfit.results.colours`."""
STYLE: dict[str, dict[str, Any]] = {
    "measured": {"color": MEASURED, "marker": "o", "markersize": 3.5, "linestyle": "none"},
    "reference": {"color": REFERENCE, "linestyle": "--", "linewidth": 1.4},
    "calibrated": {"linestyle": "-", "linewidth": 1.8},
}
NEIGHBOUR_LINES = {"atrium": ":", "artery": "--"}
Curves = Mapping[str, Curve]
Styles = Mapping[str, dict[str, Any]]


def line_styles(colour: str) -> dict[str, dict[str, Any]]:
    """Return the style of each motion, the calibrated one in the colour of its setting."""
    return STYLE | {"calibrated": STYLE["calibrated"] | {"color": colour}}


def plot_case(
    curves: Mapping[str, Curves], title: str, operator: CurveFeatures, colour: str, shift: float = 0.0
) -> Figure:
    """Plot volume, flow, pressure and pressure-volume loop, one row per ventricle.

    curves: "measured", "reference" (prior X0) and "calibrated", time zero at the trigger; a failed beat is omitted.
    The observation operator takes the flows, so that simulation and measurement are comparable. colour: of the setting;
    shift: simulated time of measured time zero [s], subtracted from the simulated times; NaN if no shift was fitted.
    """
    figure = Figure(figsize=(13, 6), layout="constrained")
    axes = figure.subplots(2, 4)
    start, styles = shift if np.isfinite(shift) else 0.0, line_styles(colour)
    shifted = {
        name: shift_curves(group, 0.0 if name == "measured" else start) for name, group in curves.items()
    }
    for row, (side, (label, atrium, artery)) in zip(axes, SIDES.items(), strict=True):
        _volumes(row[0], shifted, side, label, styles)
        _flows(row[1], shifted, side, operator, styles)
        _pressures(row[2], shifted, side, {"atrium": atrium, "artery": artery}, styles)
        _loops(row[3], shifted, side, styles)
    for panel in (axes[0, 0], axes[0, 2]):
        if panel.get_legend_handles_labels()[0]:
            panel.legend(frameon=False, fontsize=8)
    figure.suptitle(
        title + (f" (simulated trigger shifted by {1e3 * start:+.0f} ms)" if start else ""), fontsize=11
    )
    return figure


def plot_sensitivity(posterior: Posterior, title: str) -> Figure:
    """Plot the normalised Cov(X, Z) as bars, with the singular values in the title."""
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
    axes.legend(frameon=False, ncols=min(count, 4), fontsize=9)
    clean(axes)
    return figure


def _volumes(axes: Axes, curves: Mapping[str, Curves], side: str, label: str, styles: Styles) -> None:
    for name, group in curves.items():
        curve = group.get(f"{side}_volume")
        if curve is not None:
            axes.plot(curve.times, 1e6 * curve.values, label=name, **styles[name])
    _label(axes, "time after trigger (s)", "volume (mL)", label)


def _flows(
    axes: Axes, curves: Mapping[str, Curves], side: str, operator: CurveFeatures, styles: Styles
) -> None:
    for name, group in curves.items():
        if f"{side}_volume" in group:
            rate = operator.rate(group[f"{side}_volume"])
            axes.plot(rate.times, 1e6 * rate.values, **styles[name])
    axes.axhline(0, color="black", linewidth=0.6)
    _label(axes, "time after trigger (s)", "dV/dt (mL/s)", f"{operator.frames} frames")


def _pressures(
    axes: Axes, curves: Mapping[str, Curves], side: str, neighbours: Mapping[str, str], styles: Styles
) -> None:
    for name, group in curves.items():
        curve = group.get(f"{side}_pressure")
        if curve is not None:
            axes.plot(curve.times, 1e-3 * curve.values, **styles[name])
    shade = styles["calibrated"]["color"]
    for label, place in neighbours.items():
        curve = curves.get("calibrated", {}).get(f"{place}_pressure")
        if curve is not None:
            line = NEIGHBOUR_LINES[label]
            axes.plot(curve.times, 1e-3 * curve.values, line, color=shade, linewidth=1.1, label=label)
    _label(axes, "time after trigger (s)", "pressure (kPa)", "calibrated, with atrium and artery")


def _loops(axes: Axes, curves: Mapping[str, Curves], side: str, styles: Styles) -> None:
    for name, group in curves.items():
        if {f"{side}_volume", f"{side}_pressure"} <= set(group):
            volume = group[f"{side}_volume"]
            closed = np.append(np.arange(volume.times.size), 0)
            pressure = group[f"{side}_pressure"](volume.times)
            axes.plot(1e6 * volume.values[closed], 1e-3 * pressure[closed], **styles[name])
    _label(axes, "volume (mL)", "pressure (kPa)", "loop")


def shift_curves(group: Curves, shift: float) -> dict[str, Curve]:
    """Return the shifted curves with their samples sorted into [0, period)."""
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
    """Hide the top and the right spine."""
    axes.spines[["top", "right"]].set_visible(False)


def colour(index: int) -> str:
    """Return one of the colours of Okabe and Ito, in an order that suits lines."""
    return ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")[index % 7]


COLUMNS = 7
PERTURBATION_STYLES = {"-": ("#0072B2", "low"), "": ("#999999", "mean"), "+": ("#D55E00", "high")}
PERTURBED_CURVES = (("lv_volume", 1e6, "volume (mL)"), ("lv_pressure", 1e-3, "pressure (kPa)"))


def plot_perturbations(
    curves: Mapping[str, Mapping[str, Curve]], parameters: Sequence[str], title: str, step: float
) -> Figure:
    """Plot volume and pressure of the left ventricle for one-at-a-time perturbations, one column per parameter.

    curves: by point, "centre", "sigma_0+", "sigma_0-", ...; a failed beat has none and is omitted. step: prior
    standard deviations between mean and low or high.
    """
    bands = -(-len(parameters) // COLUMNS)
    figure = Figure(figsize=(12, 3.6 * bands), layout="constrained")
    axes = figure.subplots(2 * bands, COLUMNS, sharex=True, sharey=False, squeeze=False)
    for index, name in enumerate(parameters):
        band, column = divmod(index, COLUMNS)
        for row, (curve, unit, label) in enumerate(PERTURBED_CURVES):
            panel = axes[len(PERTURBED_CURVES) * band + row, column]
            _lines(panel, curves, name, curve, unit)
            panel.set_ylabel(label if column == 0 else "")
        axes[2 * band, column].set_title(symbol(name), fontsize=11)
    _share_limits(axes, len(parameters))
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper right", frameon=False, ncols=3)
    figure.supxlabel("time after trigger (s)", fontsize=10)
    figure.suptitle(f"{title}: low and high are {step:g} sd of the prior from the mean", fontsize=11)
    return figure


def _lines(axes: Axes, curves: Mapping[str, Mapping[str, Curve]], name: str, curve: str, unit: float) -> None:
    for sign, (colour, label) in PERTURBATION_STYLES.items():
        shown = curves[f"{name}{sign}" if sign else "centre"].get(curve)
        if shown is not None:
            fine = shown.resampled(200)
            axes.plot(fine.times, unit * fine.values, color=colour, linewidth=1.4, label=label)


def _share_limits(axes: np.ndarray, used: int) -> None:
    """Set the same limits for each kind of curve, and hide panels without a parameter."""
    for kind in range(len(PERTURBED_CURVES)):
        panels = axes[kind :: len(PERTURBED_CURVES)].ravel()
        low, high = zip(*(panel.get_ylim() for panel in panels[:used]), strict=True)
        for index, panel in enumerate(panels):
            clean(panel)
            panel.set_ylim(min(low), max(high))
            panel.tick_params(labelsize=8, labelleft=index % COLUMNS == 0)
            panel.set_visible(index < used)
