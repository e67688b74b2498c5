"""Sensitivities of the observations, the selection of parameters, and Sobol indices, as tables and figures."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.patches import Rectangle

from heartfit.calibration.plausible import Plausible
from heartfit.calibration.selection import (
    decomposition,
    rank_among_all,
    select,
    squared_share,
    volume_share,
)
from heartfit.calibration.sensitivity import Sensitivity
from heartfit.calibration.sobol import SobolIndices
from heartfit.core.parameter import printed_unit, to_printed_unit
from heartfit.results.errors import PAPER
from heartfit.results.figures import clean
from heartfit.results.text import symbol

VOLUME = ("V_min", "q_max", "q_min")


def sensitivity_table(sensitivity: Sensitivity, units: Mapping[str, str]) -> pd.DataFrame:
    """Return one row per parameter: prior, normalised Cov(X, Z) by observation, and its share of the squares.

    "volume (%)": for the three observations of the volume curve, "all (%)": for all; a column adds up to 100.
    """
    squares = [100 * _share(sensitivity.of(names)) for names in (VOLUME, sensitivity.observations)]
    median = sensitivity.prior.physical()
    return pd.DataFrame(
        [
            {
                "parameter": name,
                "unit": printed_unit(units[name]),
                "mean": to_printed_unit(median[name], units[name]),
                "sd (%)": 100 * sensitivity.prior.sd[i],
                **dict(zip(sensitivity.observations, sensitivity.covariance[i].tolist(), strict=True)),
                "volume (%)": squares[0][i],
                "all (%)": squares[1][i],
            }
            for i, name in enumerate(sensitivity.parameters)
        ]
    )


def _share(covariance: np.ndarray) -> Any:
    squares = (covariance**2).sum(axis=1)
    return squares / squares.sum()


def _slopes(sensitivity: Sensitivity, parameter: str) -> list[float]:
    """Return d ln Z / d ln p of each observation."""
    return list(sensitivity.slopes[sensitivity.parameters.index(parameter)].tolist())


def bulk_modulus_table(sensitivities: Mapping[str, Sensitivity], units: Mapping[str, str]) -> pd.DataFrame:
    """Return per setting the change of each observation in percent for one percent of K: d ln Z / d ln K.

    A sphere with an incompressible wall has zero in each column.
    """
    rows = [
        {
            "setting": setting,
            f"K ({printed_unit(units['K'])})": to_printed_unit(sensitivity.prior.physical()["K"], units["K"]),
            **dict(zip(sensitivity.observations, _slopes(sensitivity, "K"), strict=True)),
        }
        for setting, sensitivity in sensitivities.items()
        if "K" in sensitivity.parameters
    ]
    return pd.DataFrame(rows)


SELECTION_COLOUR = "#D55E00"


def plot_sensitivities(sensitivity: Sensitivity, title: str) -> Figure:
    """Plot Cov(X, Z), and the left singular vectors for the observations of the volume and for all six.

    The singular value is below each vector; boxed rows are the four and the seven parameters that the rule selects,
    with their order.
    """
    figure = Figure(figsize=(11, 6.2), layout="constrained")
    axes = figure.subplots(1, 3, width_ratios=(6, 3.4, 6))
    _map(
        axes[0],
        sensitivity.covariance,
        sensitivity.parameters,
        [symbol(name) for name in sensitivity.observations],
    )
    axes[0].set_title("normalised Cov(X, Z)", fontsize=10)
    for panel, names, count in ((axes[1], VOLUME, 4), (axes[2], sensitivity.observations, 7)):
        image = _vectors(panel, sensitivity, names, count)
    figure.colorbar(image, ax=axes, shrink=0.6, label="normalised covariance or component")
    figure.suptitle(title, fontsize=11)
    return figure


def _vectors(axes: Axes, sensitivity: Sensitivity, names: Sequence[str], count: int) -> AxesImage:
    covariance = sensitivity.of(names)
    left, values, _ = decomposition(covariance)
    image = _map(axes, left, sensitivity.parameters, [f"{value:.2f}" for value in values])
    for order, row in enumerate(select(covariance, count), start=1):
        corner, width = (-0.48, row - 0.46), len(values) - 0.04
        axes.add_patch(
            Rectangle(corner, width, 0.92, facecolor="none", edgecolor=SELECTION_COLOUR, linewidth=1.8)
        )
        axes.annotate(
            str(order), (len(values) - 0.45, row), color=SELECTION_COLOUR, va="center", annotation_clip=False
        )
    observed = "volume" if names == VOLUME else "volume and pressure"
    axes.set_title(f"singular vectors, {observed}", fontsize=10)
    axes.set_xlabel(f"singular values; boxed: the {count} selected parameters", fontsize=9)
    return image


def _map(axes: Axes, values: np.ndarray, rows: Sequence[str], columns: Sequence[str]) -> AxesImage:
    image = axes.imshow(values, cmap="RdBu_r", vmin=-1, vmax=1, aspect="auto")
    axes.set_xticks(range(len(columns)), columns, fontsize=8)
    axes.set_yticks(range(len(rows)), [symbol(name) for name in rows])
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    for (i, j), value in np.ndenumerate(values):
        shade = "white" if abs(value) > 0.6 else "black"
        axes.text(j, i, _cell_text(value), ha="center", va="center", fontsize=7.5, color=shade)
    return image


def _cell_text(value: float) -> str:
    return "" if abs(value) < 0.005 else f"{value:.2f}"


FOUR = ("sigma_0", "mu", "K", "R_p")
SEVEN = (*FOUR, "k_RS", "k_ATP", "c_1")
"""Parameters that the paper selects from a volume curve, and from volume and pressure."""

Sets = Mapping[str, Sequence[str]]


def selection_table(
    sensitivities: Mapping[str, Sensitivity],
    ranges: Mapping[str, Plausible],
    estimated: Mapping[str, tuple[Sequence[str], Sequence[str]]],
) -> pd.DataFrame:
    """Return per setting the selections by the rule, by the paper and by the study, with two measures of each.

    estimated: parameters that the study estimates from volume, and from volume and pressure. "squares (%)": share of
    the squared Cov(X, Z); "volume of Z (%)": det(A_S^T A_S) / det(A^T A), empty for fewer parameters than
    observations, which leave a combination of these unmoved; "place": rank among all sets of as many parameters by that
    measure. The rule is applied under the prior of the study and, in a second row, under the deviations of the
    plausible ranges.
    """
    rows = [
        row
        for setting, sensitivity in sensitivities.items()
        for names, paper, study in zip(
            (VOLUME, sensitivity.observations), (FOUR, SEVEN), estimated[setting], strict=True
        )
        for row in _selection_rows(
            setting, sensitivity, ranges[setting], names, {PAPER: paper, "this study": study}
        )
    ]
    return pd.DataFrame(rows)


def _selection_rows(
    setting: str, sensitivity: Sensitivity, ranges: Plausible, names: Sequence[str], sets: Sets
) -> Iterator[dict[str, Any]]:
    common = {"setting": setting, "observed": "volume" if names == VOLUME else "volume and pressure"}
    count = len(next(iter(sets.values())))
    for label, candidate in (
        ("rule", sensitivity),
        ("rule, plausible prior", sensitivity.with_sd(ranges.sd)),
    ):
        chosen = [sensitivity.parameters[index] for index in select(candidate.of(names), count)]
        yield common | {"chosen by": label} | _selection_row(candidate, names, chosen)
    for label, parameters in sets.items():
        if set(parameters) <= set(sensitivity.parameters):
            yield common | {"chosen by": label} | _selection_row(sensitivity, names, parameters)


def _selection_row(sensitivity: Sensitivity, names: Sequence[str], chosen: Sequence[str]) -> dict[str, Any]:
    covariance = sensitivity.of(names)
    rows = [sensitivity.parameters.index(name) for name in chosen]
    row: dict[str, Any] = {"parameters": ", ".join(chosen)}
    for label, place, measure in (
        ("squares (%)", "place by squares", squared_share),
        ("volume of Z (%)", "place by volume", volume_share),
    ):
        if measure is volume_share and len(rows) < len(names):
            row |= {label: np.nan, place: ""}
            continue
        better, sets = rank_among_all(covariance, rows, measure)
        row |= {label: 100 * measure(covariance, rows), place: f"{better} of {sets}"}
    return row


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
MARKERS = "o^sDvP"


def plot_sobol(
    indices: SobolIndices, sensitivities: Mapping[str, Sensitivity], colours: Mapping[str, str]
) -> Figure:
    """Plot first and total index of each parameter and squared covariances of the mesh, one panel per observation.

    sensitivities: by setting; for a linear map their squares equal the indices. colours: of the settings.
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
        for place, (setting, sensitivity) in enumerate(sensitivities.items()):
            squares = sensitivity.of([name])[:, 0] ** 2
            panel.plot(
                squares,
                places,
                MARKERS[place % len(MARKERS)],
                color=colours[setting],
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
