"""Noise model and image sensors as tables and a figure."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.observation.noise_model import (
    CURVE_OF_EXTREMUM,
    NoiseModel,
    Share,
    curve_error,
    observation_errors,
)
from heartfit.observation.operator import Pair
from heartfit.observation.scatter import Scatter
from heartfit.results.figures import CALIBRATED, MEASURED, clean
from heartfit.results.text import symbol

SENSORS = {
    "shrinkage": ("shrinkage (%)", 0.01),
    "smoothing": ("smoothing (ms)", 1e-3),
    "delay": ("delay (ms)", 1e-3),
}
"""Printed name of a sensor and SI value of its printed unit."""


def noise_model_table(model: NoiseModel, shares: Mapping[str, Share]) -> pd.DataFrame:
    """Return one row per observation and one per volume: bias, deviation and coverage of the intervals.

    bias (median) and deviation in percent: for a rate over its true value, for V_min and a volume over its measured
    stroke volume, as in the model (P_max: over the range of pressure). The row of a volume is the phase of the
    largest deviation, but its coverage is that of all phases; "covered": share of fresh sequences with the truth in
    the 95 % interval, with its exact interval (`heartfit.observation.noise_model`).
    """
    scatter = model.observations
    bias = np.where(
        [name in CURVE_OF_EXTREMUM for name in scatter.names], scatter.mean, np.expm1(scatter.mean)
    )
    rows = [
        _error_row(name, mean, sd, shares[name])
        for name, mean, sd in zip(scatter.names, bias, scatter.sd, strict=True)
    ]
    rows += [_volume_row(name, curve, shares[name]) for name, curve in model.curves.items()]
    return pd.DataFrame(rows)


def _volume_row(name: str, curve: Scatter, share: Share) -> dict[str, Any]:
    worst = int(curve.sd.argmax())
    title = f"{name[:2].upper()} volume, {curve.names[worst]}"
    return _error_row(title, curve.mean[worst], curve.sd[worst], share)


def sensor_table(sensors: Scatter) -> pd.DataFrame:
    """Return mean and standard deviation over the sequences of the fitted image sensors."""
    printed = [SENSORS[name] for name in sensors.names]
    units = np.array([unit for _, unit in printed])
    names = [name for name, _ in printed]
    return pd.DataFrame({"sensor": names, "mean": sensors.mean / units, "sd": sensors.sd / units})


def _error_row(name: str, bias: float, sd: float, share: Share) -> dict[str, Any]:
    return {
        "observation": name,
        "bias (%)": 100.0 * bias,
        "sd (%)": 100.0 * sd,
        "covered (%)": 100.0 * share.covered,
        "covered, low (%)": 100.0 * share.low,
        "covered, high (%)": 100.0 * share.high,
        "fresh sequences": share.sequences,
    }


LEVEL = 0.95
BAND: dict[str, Any] = {"color": CALIBRATED, "alpha": 0.25, "linewidth": 0.0}


def plot_noise_model(model: NoiseModel, fresh: Sequence[Pair]) -> Figure:
    """Plot errors of fresh sequences in the intervals of the model: observations, volume, and one corrected volume."""
    figure = Figure(figsize=(13, 3.8), layout="constrained")
    observations, errors, volume = figure.subplots(1, 3)
    _observations(observations, model, fresh)
    _errors(errors, model, fresh)
    _volume(volume, model, fresh[0])
    for axes in (observations, errors, volume):
        clean(axes)
    return figure


def _observations(axes: Axes, model: NoiseModel, fresh: Sequence[Pair]) -> None:
    """Plot errors in the units of the model, one point per fresh sequence."""
    scatter, places = model.observations, np.arange(len(model.observations.names))
    errors = 100.0 * np.array([observation_errors(pair, scatter.names) for pair in fresh])
    mean, reach = 100.0 * scatter.mean, 100.0 * scatter.half_width(LEVEL)
    axes.bar(places, 2.0 * reach, 0.5, bottom=mean - reach, label=f"{100 * LEVEL:g} % interval", **BAND)
    axes.hlines(mean, places - 0.25, places + 0.25, color=CALIBRATED, label="bias")
    spread = np.linspace(-0.2, 0.2, len(fresh)) if len(fresh) > 1 else np.zeros(1)
    for place, column in zip(places, errors.T, strict=True):
        axes.plot(place + spread, column, ".", color=MEASURED, markersize=4)
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.set_xticks(places, [symbol(name) + _scale(name) for name in scatter.names], fontsize=9)
    axes.set_ylabel("error (%)")
    axes.legend(frameon=False, fontsize=8)


def _scale(name: str) -> str:
    """Return the unit of an error for the axis: share of the range of the curve, or logarithm of the ratio."""
    return "\nof range" if name in CURVE_OF_EXTREMUM else "\nln ratio"


def _errors(axes: Axes, model: NoiseModel, fresh: Sequence[Pair]) -> None:
    """Plot the error of the volume over the measured stroke volume for each phase."""
    phases, curve = model.phases, model.curves["lv_volume"]
    share = np.arange(phases) / phases
    mean, reach = 100.0 * curve.mean, 100.0 * curve.half_width(LEVEL)
    axes.fill_between(share, mean - reach, mean + reach, label=f"{100 * LEVEL:g} % interval", **BAND)
    for number, pair in enumerate(fresh):
        label = "_" if number else "fresh sequences"
        error = 100.0 * curve_error(pair, phases)
        axes.plot(share, error, color=MEASURED, linewidth=0.5, alpha=0.6, label=label)
    axes.plot(share, mean, color=CALIBRATED, linewidth=1.8, label="bias")
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.set_xlabel("phase of the beat")
    axes.set_ylabel("error of LV volume (% of stroke volume)")
    axes.legend(frameon=False, fontsize=8)


def _volume(axes: Axes, model: NoiseModel, pair: Pair) -> None:
    measured, true = pair.measured.curves["lv_volume"], pair.true.curves["lv_volume"]
    corrected = model.corrected_curve(measured)
    low, high = model.curve_interval(measured, LEVEL)
    axes.fill_between(corrected.times, 1e6 * low, 1e6 * high, label=f"{100 * LEVEL:g} % interval", **BAND)
    axes.plot(corrected.times, 1e6 * corrected.values, color=CALIBRATED, linewidth=1.8, label="without bias")
    axes.plot(measured.times, 1e6 * measured.values, "--", color=CALIBRATED, linewidth=1.0, label="measured")
    axes.plot(true.times, 1e6 * true.values, ".", color=MEASURED, markersize=5, label="true")
    axes.set_xlabel("time after trigger (s)")
    axes.set_ylabel("LV volume (mL)")
    axes.legend(frameon=False, fontsize=8)
