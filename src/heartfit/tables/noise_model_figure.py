"""What a noise model was learnt from, and what it makes of it."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.observation.noise_model import EXTREMA, NoiseModel, curve_error, observation_errors
from heartfit.observation.pair import Pair
from heartfit.tables.figures import CALIBRATED, MEASURED, clean
from heartfit.tables.text import symbol

LEVEL = 0.95
BAND: dict[str, Any] = {"color": CALIBRATED, "alpha": 0.25, "linewidth": 0.0}


def plot_noise_model(model: NoiseModel, fresh: Sequence[Pair]) -> Figure:
    """Errors of sequences the model has not seen, in its intervals: observations, volume, and one volume corrected."""
    figure = Figure(figsize=(13, 3.8), layout="constrained")
    observations, errors, volume = figure.subplots(1, 3)
    _observations(observations, model, fresh)
    _errors(errors, model, fresh)
    _volume(volume, model, fresh[0])
    for axes in (observations, errors, volume):
        clean(axes)
    return figure


def _observations(axes: Axes, model: NoiseModel, fresh: Sequence[Pair]) -> None:
    """Errors as the model has them, each fresh sequence a point."""
    scatter, places = model.observations, np.arange(len(model.observations.names))
    errors = 100.0 * np.array([observation_errors(pair, scatter.names) for pair in fresh])
    mean, reach = 100.0 * scatter.mean, 100.0 * scatter.reach(LEVEL)
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
    """What an error is compared with, for the axis: the range of the curve, or by the logarithm of the ratio."""
    return "\nof range" if name in EXTREMA else "\nln ratio"


def _errors(axes: Axes, model: NoiseModel, fresh: Sequence[Pair]) -> None:
    """Error of the volume over the measured stroke volume, phase by phase."""
    phases = len(model.curve.names)
    share = np.arange(phases) / phases
    mean, reach = 100.0 * model.curve.mean, 100.0 * model.curve.reach(LEVEL)
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
