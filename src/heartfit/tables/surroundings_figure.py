"""Fig. 2 of the paper, for every parameter: the beat with the parameter low, at its mean, and high."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.observation.curve import Curve
from heartfit.tables.figures import clean
from heartfit.tables.text import symbol

COLUMNS = 7
STYLE = {"-": ("#0072B2", "low"), "": ("#999999", "mean"), "+": ("#D55E00", "high")}
SHOWN = (("lv_volume", 1e6, "volume (mL)"), ("lv_pressure", 1e-3, "pressure (kPa)"))


def plot_surroundings(
    curves: Mapping[str, Mapping[str, Curve]], parameters: Sequence[str], title: str, step: float
) -> Figure:
    """Volume above pressure of the left ventricle, a column for each parameter, over time after the trigger.

    curves: those of the points "centre", "sigma_0+", "sigma_0-", ...; a beat that failed has none and is left out.
    step: standard deviations of the prior between mean and low or high.
    """
    bands = -(-len(parameters) // COLUMNS)
    figure = Figure(figsize=(12, 3.6 * bands), layout="constrained")
    axes = figure.subplots(2 * bands, COLUMNS, sharex=True, sharey=False, squeeze=False)
    for index, name in enumerate(parameters):
        band, column = divmod(index, COLUMNS)
        for row, (curve, unit, label) in enumerate(SHOWN):
            panel = axes[len(SHOWN) * band + row, column]
            _lines(panel, curves, name, curve, unit)
            panel.set_ylabel(label if column == 0 else "")
        axes[2 * band, column].set_title(symbol(name), fontsize=11)
    _frame(axes, len(parameters))
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper right", frameon=False, ncols=3)
    figure.supxlabel("time after trigger (s)", fontsize=10)
    figure.suptitle(f"{title}: low and high are {step:g} sd of the prior from the mean", fontsize=11)
    return figure


def _lines(axes: Axes, curves: Mapping[str, Mapping[str, Curve]], name: str, curve: str, unit: float) -> None:
    for sign, (colour, label) in STYLE.items():
        shown = curves[f"{name}{sign}" if sign else "centre"].get(curve)
        if shown is not None:
            fine = shown.resampled(200)
            axes.plot(fine.times, unit * fine.values, color=colour, linewidth=1.4, label=label)


def _frame(axes: np.ndarray, used: int) -> None:
    """The same limits for each kind of curve, and nothing where there is no parameter."""
    for kind in range(len(SHOWN)):
        panels = axes[kind :: len(SHOWN)].ravel()
        low, high = zip(*(panel.get_ylim() for panel in panels[:used]), strict=True)
        for index, panel in enumerate(panels):
            clean(panel)
            panel.set_ylim(min(low), max(high))
            panel.tick_params(labelsize=8, labelleft=index % COLUMNS == 0)
            panel.set_visible(index < used)
