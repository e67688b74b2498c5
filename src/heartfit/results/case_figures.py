"""Figures of a calibrated case: its curves, the sensitivity of its observations, and the shape of its motion."""

from collections.abc import Mapping

import pandas as pd
from matplotlib.figure import Figure

from heartfit.calibration.update import Posterior
from heartfit.observation.operator import CurveFeatures
from heartfit.results.case import CaseResult
from heartfit.results.figures import Curves, clean, line_styles, plot_case, plot_sensitivity
from heartfit.results.shape import COLUMNS, VOLUME_COLUMNS


def case_figures(
    result: CaseResult,
    curves: Mapping[str, Curves],
    operator: CurveFeatures,
    posterior: Posterior,
    shapes: Mapping[str, pd.DataFrame],
    colour: str,
) -> dict[str, Figure]:
    """Plot the figures by name; curves and shapes by motion, see plot_case and plot_shape; colour: of the setting."""
    name, title = f"{result.case}_{result.setting}", f"{result.case}, {result.setting} setting"
    return {
        name: plot_case(curves, title, operator, colour, result.shift),
        f"{name}_sensitivity": plot_sensitivity(posterior, title),
        f"{name}_shape": plot_shape(shapes, title, colour),
    }


def plot_shape(shapes: Mapping[str, pd.DataFrame], title: str, colour: str) -> Figure:
    """Plot one panel per curve over the time after the trigger; the last has the spread of the element volumes.

    shapes: "measured" and "calibrated", from shape_table and beat_shape_table; a failed beat has no rows and no line.
    colour: of the setting.
    """
    styles = line_styles(colour)
    figure = Figure(figsize=(13, 6), layout="constrained")
    panels = figure.subplots(2, 4).ravel()
    for name, shape in shapes.items():
        for axes, column in zip(panels, COLUMNS, strict=False):
            axes.plot(shape["time (s)"], shape[column], label=name, **styles[name])
        for column in (VOLUME_COLUMNS[0], VOLUME_COLUMNS[-1]):
            panels[-1].plot(shape["time (s)"], shape[column], **styles[name])
    for axes, heading in zip(panels, (*COLUMNS, "element volume, 1st and 99th percentile"), strict=True):
        axes.set_title(heading, fontsize=9)
        axes.set_xlabel("time after trigger (s)")
        clean(axes)
    panels[0].legend(frameon=False, fontsize=8)
    figure.suptitle(title, fontsize=11)
    return figure
