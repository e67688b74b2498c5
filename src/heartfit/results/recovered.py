"""Figure of functions that a search has recovered, beside the hidden ones."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.cause import PlaceFunction
from heartfit.results.acting_figure import plot_with_band
from heartfit.results.acting_places import acts
from heartfit.results.figures import MEASURED


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
    plot_with_band(axes, one.function, one.hidden, "hidden", MEASURED)
    region, r = acts(one.function.region), one.correlation()
    axes.set_title(f"{name}: acts\n{region}, r = {r:.2f}", fontsize=9, fontweight="bold")
