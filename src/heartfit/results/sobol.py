"""Sobol indices of the sphere as a table and a figure."""

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from heartfit.calibration.sensitivity import Sensitivity
from heartfit.calibration.sobol import SobolIndices
from heartfit.results.figures import clean
from heartfit.results.text import symbol


def sobol_table(indices: SobolIndices) -> pd.DataFrame:
    """Return one row per parameter: first (S) and total (T) index of each observation [%], and the number of beats.

    The wall of the sphere is incompressible: its bulk modulus K has no effect.
    """
    rows = []
    for i, name in enumerate(indices.parameters):
        row: dict[str, object] = {"parameter": name}
        for j, observation in enumerate(indices.observations):
            row[f"{observation} S (%)"] = 100 * float(indices.first[i, j])
            row[f"{observation} T (%)"] = 100 * float(indices.total[i, j])
        row["T +- (%)"] = 100 * float(indices.total_error[i].max())
        row["note"] = "" if indices.total[i].any() else "no effect: the wall of the sphere is incompressible"
        rows.append(row)
    beats = indices.samples * (len(indices.parameters) + 2)
    omitted = f"; {len(indices.lost)} base samples left out" if indices.lost else ""
    rows.append({"parameter": "beats", "note": f"{beats} beats of {indices.samples} base samples{omitted}"})
    return pd.DataFrame(rows)


FIRST, INTERACTION = "#0072B2", "#56B4E9"
MESHES = {"markers": ("o", "^", "s"), "colours": ("#D55E00", "#000000", "#009E73")}


def plot_sobol(indices: SobolIndices, sensitivities: Mapping[str, Sensitivity]) -> Figure:
    """Plot first and total index of each parameter and squared covariances of the mesh, one panel per observation.

    sensitivities: by setting; for a linear map their squares equal the indices.
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
        panel.barh(places, indices.first[:, j], 0.4, color=FIRST, label="sphere, first")
        for (setting, sensitivity), marker, colour in zip(
            sensitivities.items(), MESHES["markers"], MESHES["colours"], strict=False
        ):
            squares = sensitivity.of([name])[:, 0] ** 2
            panel.plot(
                squares,
                places,
                marker,
                color=colour,
                markersize=4.5,
                label=f"mesh, {setting}: squared covariance",
            )
        panel.set_title(symbol(name), fontsize=11)
        panel.set_yticks(places, [symbol(parameter) for parameter in indices.parameters])
        clean(panel)
    axes[0].invert_yaxis()
    axes[0].legend(frameon=False, fontsize=8)
    beats = indices.samples * (len(indices.parameters) + 2)
    figure.suptitle(f"Sobol indices of the left ventricle as a sphere, {beats} beats", fontsize=11)
    figure.supxlabel("share of the variance of the observation", fontsize=10)
    return figure
