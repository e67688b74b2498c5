"""How the left ventricle moves over the beat, measured and calibrated."""

from collections.abc import Mapping

import pandas as pd
from matplotlib.figure import Figure

from heartfit.tables.figures import STYLE
from heartfit.tables.shape_table import COLUMNS, SPREAD


def plot_shape(shapes: Mapping[str, pd.DataFrame], title: str) -> Figure:
    """One panel per curve over the time after the trigger; the last one holds the spread of the elements' volumes.

    shapes: "measured" and "calibrated", see heartfit.tables.shape_table; a beat that failed is left out.
    """
    figure = Figure(figsize=(13, 6), layout="constrained")
    panels = figure.subplots(2, 4).ravel()
    for name, shape in shapes.items():
        for axes, column in zip(panels, COLUMNS, strict=False):
            axes.plot(shape["time (s)"], shape[column], label=name, **STYLE[name])
        for column in (SPREAD[0], SPREAD[-1]):
            panels[-1].plot(shape["time (s)"], shape[column], **STYLE[name])
    for axes, heading in zip(panels, (*COLUMNS, "element volume, 1st and 99th percentile"), strict=True):
        axes.set_title(heading, fontsize=9)
        axes.set_xlabel("time after trigger (s)")
        axes.spines[["top", "right"]].set_visible(False)
    panels[0].legend(frameon=False, fontsize=8)
    figure.suptitle(title, fontsize=11)
    return figure
