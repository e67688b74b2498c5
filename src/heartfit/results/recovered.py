"""Figure of functions that a search has recovered, beside the hidden ones."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.cause import PlaceFunction
from heartfit.results.acting_places import acts
from heartfit.results.figures import CALIBRATED, MEASURED, REFERENCE, clean
from heartfit.results.text import AMPLITUDE_UNITS


@dataclass(frozen=True, eq=False)
class Recovered:
    """A function with its posterior, and the hidden one (k,) at the same times in the same unit."""

    function: PlaceFunction
    hidden: Floats

    def correlation(self) -> float:
        """Return the correlation of both over the beat, every time weighted by the inverse of the variance."""
        weights = self.function.sd**-2 / np.sum(self.function.sd**-2)
        one, other = (values - np.sum(weights * values) for values in (self.function.mean, self.hidden))
        covariance = np.sum(weights * one * other)
        return float(covariance / np.sqrt(np.sum(weights * one**2) * np.sum(weights * other**2)))


def plot_recovered(functions: Mapping[str, Recovered]) -> Figure:
    """Plot a panel for each hidden effect: the hidden function, and the recovered one with its 95 % band."""
    figure = Figure(figsize=(3.6 * len(functions), 3.4), layout="constrained")
    panels = figure.subplots(1, len(functions), squeeze=False)[0]
    for axes, (name, one) in zip(panels, functions.items(), strict=True):
        _plot_one(axes, name, one)
    panels[0].legend(frameon=False, fontsize=8)
    return figure


def _plot_one(axes: Axes, name: str, one: Recovered) -> None:
    function = one.function
    unit, factor = AMPLITUDE_UNITS[function.unit]
    mean, reach = factor * function.mean, 2.0 * factor * function.sd
    axes.axhline(0.0, color="black", linewidth=0.6)
    axes.fill_between(function.times, mean - reach, mean + reach, color=REFERENCE, alpha=0.35, linewidth=0)
    axes.plot(function.times, mean, color=CALIBRATED, linewidth=1.6, label="recovered, 95 % band")
    axes.plot(function.times, factor * one.hidden, "--", color=MEASURED, linewidth=1.4, label="hidden")
    axes.set_title(
        f"{name}: acts\n{acts(function.region)}, r = {one.correlation():.2f}", fontsize=9, fontweight="bold"
    )
    axes.set_xlabel("time after trigger (s)")
    axes.set_ylabel(f"({unit})")
    clean(axes)
