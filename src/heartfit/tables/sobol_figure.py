"""Sobol's indices of the sphere beside the squared Cov(X, Z) of the mesh."""

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from heartfit.sensitivity.covariance import Sensitivity
from heartfit.sensitivity.sobol import SobolIndices
from heartfit.tables.figures import clean
from heartfit.tables.text import symbol

FIRST, INTERACTION = "#0072B2", "#56B4E9"
MESHES = {"markers": ("o", "^", "s"), "colours": ("#D55E00", "#000000", "#009E73")}


def plot_sobol(indices: SobolIndices, found: Mapping[str, Sensitivity]) -> Figure:
    """One panel per observation: first and total index of each parameter, and what the mesh says of the same.

    found: sensitivities by setting, whose squares are what an index is for a linear map.
    """
    figure = Figure(figsize=(12, 7), layout="constrained")
    axes = figure.subplots(2, 3, sharey=True, sharex=True).ravel()
    places = np.arange(len(indices.parameters))
    for j, (panel, name) in enumerate(zip(axes, indices.observations, strict=False)):
        error = {"ecolor": "#555555", "elinewidth": 0.9}
        width = indices.total_error[:, j]
        panel.barh(
            places,
            indices.total[:, j],
            0.75,
            xerr=width,
            color=INTERACTION,
            error_kw=error,
            label="sphere, total",
        )
        panel.barh(places, indices.first[:, j], 0.4, color=FIRST, label="sphere, alone")
        for (setting, each), marker, colour in zip(
            found.items(), MESHES["markers"], MESHES["colours"], strict=False
        ):
            squares = each.of([name])[:, 0] ** 2
            panel.plot(
                squares,
                places,
                marker,
                color=colour,
                markersize=4.5,
                label=f"mesh, {setting}: squared covariance",
            )
        panel.set_title(symbol(name), fontsize=11)
        panel.set_yticks(places, [symbol(each) for each in indices.parameters])
        clean(panel)
    axes[0].invert_yaxis()
    axes[0].legend(frameon=False, fontsize=8)
    beats = indices.samples * (len(indices.parameters) + 2)
    figure.suptitle(f"Sobol's indices of the left ventricle as a sphere, {beats} beats", fontsize=11)
    figure.supxlabel("share of the variance of the observation", fontsize=10)
    return figure
