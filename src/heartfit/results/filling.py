"""Figure of mitral flow and left ventricular volume of several hearts, with the measured volume of one."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.core.arrays import Floats
from heartfit.observation.curve import Curve
from heartfit.observation.operator import VolumeFeatures
from heartfit.results.figures import MEASURED, clean, colour

START = 0.2
"""Start of the time axis [s after the trigger], in ejection, so that filling is not divided."""
MILLILITRE = 1e-6
CURVES = {"mitral_flow": "mitral flow (mL/s)", "lv_volume": "left ventricular volume (mL)"}


def plot_filling(
    groups: Mapping[str, Mapping[str, Mapping[str, Curve]]], measured: Mapping[str, Curve]
) -> Figure:
    """Plot flow and volume, one row per group of hearts by name; ``measured`` holds a volume for some of the groups.

    The flow of a measured volume is its rate by central differences.
    """
    figure = Figure(figsize=(11, 3.2 * len(groups)), layout="constrained")
    panels = figure.subplots(len(groups), len(CURVES), squeeze=False)
    for row, (group, hearts) in zip(panels, groups.items(), strict=True):
        for axes, (name, label) in zip(row, CURVES.items(), strict=True):
            _hearts(axes, {heart: curves[name] for heart, curves in hearts.items()})
            if group in measured:
                _measured(axes, measured[group], name)
            axes.set_xlabel("time after the trigger (s)")
            axes.set_ylabel(label)
            axes.set_title(group, fontsize=9, loc="left")
            clean(axes)
        row[0].axhline(0.0, color="0.7", linewidth=0.8, zorder=0)
    panels[-1, 0].legend(frameon=False, fontsize=8)
    return figure


def _hearts(axes: Axes, curves: Mapping[str, Curve]) -> None:
    for index, (heart, curve) in enumerate(curves.items()):
        times = START + np.linspace(0.0, curve.period, 400)
        axes.plot(times, curve(times) / MILLILITRE, color=colour(index), linewidth=1.5, label=heart)


def _measured(axes: Axes, volume: Curve, name: str) -> None:
    shown = VolumeFeatures(volume.times.size).rate(volume) if name == "mitral_flow" else volume
    times: Floats = START + np.mod(shown.times - START, shown.period)
    axes.plot(times, shown.values / MILLILITRE, "o", color=MEASURED, markersize=3.5, label="measured")
    axes.set_ylim(bottom=max(axes.get_ylim()[0], -150.0))
