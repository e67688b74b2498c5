"""Heat map of the normalised Cov(X, Z) of all parameters, and its singular value decomposition."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Rectangle

from heartfit.sensitivity.covariance import Sensitivity
from heartfit.sensitivity.selection import decomposition, selected
from heartfit.tables.sensitivity_table import VOLUME
from heartfit.tables.text import symbol

CHOSEN = "#D55E00"


def plot_sensitivities(found: Sensitivity, title: str) -> Figure:
    """Cov(X, Z), and the left singular vectors for the volume's observations and for all six.

    Below each vector stands its singular value; boxed rows are the four and the seven that the rule chooses, in the
    order of the numbers.
    """
    figure = Figure(figsize=(11, 6.2), layout="constrained")
    axes = figure.subplots(1, 3, width_ratios=(6, 3.4, 6))
    _map(axes[0], found.covariance, found.parameters, [symbol(name) for name in found.observations])
    axes[0].set_title("normalised Cov(X, Z)", fontsize=10)
    for panel, names, count in ((axes[1], VOLUME, 4), (axes[2], found.observations, 7)):
        image = _vectors(panel, found, names, count)
    figure.colorbar(image, ax=axes, shrink=0.6, label="covariance in standard deviations, or component")
    figure.suptitle(title, fontsize=11)
    return figure


def _vectors(axes: Axes, found: Sensitivity, names: Sequence[str], count: int) -> AxesImage:
    covariance = found.of(names)
    left, values, _ = decomposition(covariance)
    image = _map(axes, left, found.parameters, [f"{value:.2f}" for value in values])
    for order, row in enumerate(selected(covariance, count), start=1):
        corner, width = (-0.48, row - 0.46), len(values) - 0.04
        axes.add_patch(Rectangle(corner, width, 0.92, facecolor="none", edgecolor=CHOSEN, linewidth=1.8))
        axes.annotate(str(order), (len(values) - 0.45, row), color=CHOSEN, va="center", annotation_clip=False)
    what = "volume" if names == VOLUME else "volume and pressure"
    axes.set_title(f"singular vectors, {what}", fontsize=10)
    axes.set_xlabel(f"singular values; boxed: the {count} chosen", fontsize=9)
    return image


def _map(axes: Axes, values: np.ndarray, rows: Sequence[str], columns: Sequence[str]) -> AxesImage:
    image = axes.imshow(values, cmap="RdBu_r", vmin=-1, vmax=1, aspect="auto")
    axes.set_xticks(range(len(columns)), columns, fontsize=8)
    axes.set_yticks(range(len(rows)), [symbol(name) for name in rows])
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    for (i, j), value in np.ndenumerate(values):
        shade = "white" if abs(value) > 0.6 else "black"
        axes.text(j, i, _short(value), ha="center", va="center", fontsize=7.5, color=shade)
    return image


def _short(value: float) -> str:
    return "" if abs(value) < 0.005 else f"{value:.2f}"
