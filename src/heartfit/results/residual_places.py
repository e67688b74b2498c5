"""Table and figure of the places at which the residual of a measured heart acts, beside several hearts."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.discovery.sphere_model.cause import PlaceFunction
from heartfit.places import REGIONS, Region
from heartfit.results.acting_places import REGIONS as NAMES
from heartfit.results.figures import MEASURED, clean, colour

KILOPASCAL = 1e3


@dataclass(frozen=True, eq=False)
class ResidualPlaces:
    """Places beside one heart: ln Bayes factors of the best place of each region, and the function in its filling.

    misfit: r'R⁻¹r of the heart alone at its most probable noise.
    """

    misfit: float
    factors: Mapping[Region, float]
    filling: PlaceFunction


def residual_table(hearts: Mapping[str, ResidualPlaces]) -> pd.DataFrame:
    """Return a row for each heart, with the ln Bayes factor of every region."""
    return pd.DataFrame(
        [
            {"heart": name, "misfit": f"{one.misfit:.0f}"}
            | {region: f"{one.factors[region]:.1f}" for region in REGIONS if region in one.factors}
            for name, one in hearts.items()
        ]
    )


def plot_residual_places(hearts: Mapping[str, ResidualPlaces], threshold: float) -> Figure:
    """Plot the evidence of every region beside the ``threshold`` of a detection, and the functions in the filling."""
    figure = Figure(figsize=(12, 4.2), layout="constrained")
    bars, curves = figure.subplots(1, 2, width_ratios=(1.0, 1.3))
    _evidence(bars, hearts, threshold)
    for index, (name, one) in enumerate(hearts.items()):
        _function(curves, one.filling, colour(index), name)
    curves.axhline(0.0, color="black", linewidth=0.6)
    curves.set_xlabel("time after trigger (s)")
    curves.set_ylabel("pressure that filling lacks (kPa), 95 % band")
    curves.legend(frameon=False, fontsize=8)
    clean(curves)
    return figure


def _evidence(axes: Axes, hearts: Mapping[str, ResidualPlaces], threshold: float) -> None:
    height, rows = 0.8 / len(hearts), np.arange(len(REGIONS))
    for index, (name, one) in enumerate(hearts.items()):
        values = [max(one.factors.get(region, 0.0), 0.0) for region in REGIONS]
        axes.barh(rows + index * height, values, height, color=colour(index), label=name)
    axes.axvline(threshold, color=MEASURED, linestyle="--", linewidth=0.9)
    axes.set_yticks(rows + 0.4 - 0.5 * height, [NAMES[region] for region in REGIONS], fontsize=8)
    axes.invert_yaxis()
    axes.set_xlabel("ln Bayes factor of a free function (dashed: detected)")
    clean(axes)


def _function(axes: Axes, function: PlaceFunction, shade: str, name: str) -> None:
    mean, reach = function.mean / KILOPASCAL, 2.0 * function.sd / KILOPASCAL
    axes.fill_between(function.times, mean - reach, mean + reach, color=shade, alpha=0.15, linewidth=0)
    axes.plot(function.times, mean, color=shade, linewidth=1.6, label=name)
