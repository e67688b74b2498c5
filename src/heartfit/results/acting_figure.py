"""The functions at the places on which something unknown acts, as panels of a figure."""

from matplotlib.axes import Axes
from matplotlib.figure import FigureBase

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.cause import ActingPlace, Diagnosis, PlaceFunction
from heartfit.results.acting_places import acts, law_text
from heartfit.results.figures import ARTERY, CALIBRATED, REFERENCE, clean
from heartfit.results.text import AMPLITUDE_UNITS


def plot_functions(figure: FigureBase, diagnosis: Diagnosis) -> None:
    """Plot one panel for each region: the function of time with its 95 % band, and the best law (dashed)."""
    panels = figure.subplots(1, len(diagnosis.functions), squeeze=False)[0]
    for axes, function, acting in zip(panels, diagnosis.functions, diagnosis.acting, strict=True):
        _plot_function(axes, function, acting)


def _plot_function(axes: Axes, function: PlaceFunction, acting: ActingPlace) -> None:
    plot_with_band(axes, function, function.law, law_text(acting.laws[0]), ARTERY)
    axes.set_title(f"acts {acts(acting.region)}", fontsize=10, fontweight="bold")
    axes.legend(frameon=False, fontsize=8)


def plot_with_band(axes: Axes, function: PlaceFunction, other: Floats, label: str, shade: str) -> None:
    """Plot a function with its 95 % band, and another one (k,) at the same times in the same unit, dashed."""
    unit, factor = AMPLITUDE_UNITS[function.unit]
    mean, reach = factor * function.mean, 2.0 * factor * function.sd
    axes.axhline(0.0, color="black", linewidth=0.6)
    low, high = mean - reach, mean + reach
    axes.fill_between(function.times, low, high, color=REFERENCE, alpha=0.35, linewidth=0, label="95 % band")
    axes.plot(function.times, mean, color=CALIBRATED, linewidth=1.6, label="free function")
    axes.plot(function.times, factor * other, "--", color=shade, linewidth=1.4, label=label)
    axes.set_xlabel("time after trigger (s)")
    axes.set_ylabel(f"added ({unit})" if unit else "added share", fontsize=9)
    clean(axes)
