"""Every parameter of everybody: the prior, the posterior, the estimate whose beat is shown, and the truth."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.calibration.gaussian import Gaussian
from heartfit.report.grid import WIDTH, grid, legend
from heartfit.report.picture import TEXT, Picture, picture
from heartfit.report.record import CaseRecord, Fit
from heartfit.tables.card import REACH
from heartfit.tables.card_figure import EDGE, draw_parameters
from heartfit.tables.display import printed, printed_unit
from heartfit.tables.figures import ARTERY, CALIBRATED, MEASURED, clean
from heartfit.tables.text import symbol

COLUMNS, HEAD, ROW, LEGEND = 4, 0.9, 0.24, 26
"""Panels in a row; inches of a panel beside its cases, and of each case; points of a line of legend."""
PRIOR = "#dddddd"


def plot_parameters(cases: Sequence[CaseRecord], setting: str) -> Picture:
    """One panel for each parameter, one row in it for each case."""
    fits = {case.name: case.fits[setting] for case in cases}
    names = list(dict.fromkeys(name for fit in fits.values() for name in fit.result.estimate))
    with rc_context(TEXT):
        figure, panels = grid(len(names), COLUMNS, HEAD + ROW * len(fits))
        for axes, name in zip(panels, names, strict=True):
            _panel(axes, fits, name)
        legend(figure, panels)
        return picture(figure, f"{', '.join(names)} of each case, setting {setting}, beside the prior")


def plot_estimates(case: CaseRecord, cases: Sequence[CaseRecord]) -> Picture:
    """One panel for each setting: every parameter of the case in prior standard deviations, the cohort's as dots."""
    most = max(len(fit.card.prior.names) for fit in case.fits.values())
    with rc_context(TEXT):
        figure = Figure(figsize=(WIDTH, HEAD + 2 * ROW * (1 + most)), layout="constrained")
        for axes, (setting, fit) in zip(
            figure.subplots(1, len(case.fits), squeeze=False)[0], case.fits.items(), strict=True
        ):
            draw_parameters(axes, fit.card)
            _others(axes, fit, [each.fits[setting] for each in cases if each is not case])
            axes.set_title(setting, pad=LEGEND)
        return picture(figure, f"Parameters of {case.name} beside the prior and the cohort")


def _others(axes: Axes, fit: Fit, others: Sequence[Fit]) -> None:
    """Estimates of the other cases that have the parameter, where they lie in this case's prior."""
    prior = fit.card.prior
    for row, name in enumerate(prior.names):
        found = [np.log(each.result.estimate[name]) for each in others if name in each.result.estimate]
        places = (np.array(found) - prior.mean[row]) / prior.sd[row]
        within = places[np.abs(places) <= EDGE]
        axes.plot(within, np.full(len(within), row + 0.39), ".", color="#666666", markersize=4)


def _panel(axes: Axes, fits: Mapping[str, Fit], name: str) -> None:
    unit = next(fit.result.units[name] for fit in fits.values() if name in fit.result.units)
    for row, fit in enumerate(fits.values()):
        if name in fit.result.estimate:
            _intervals(axes, row, fit, name)
        else:
            across = axes.get_yaxis_transform()
            axes.text(
                0.03, row, "not estimated", transform=across, va="center", fontsize=7.5, color="#555555"
            )
    axes.set_yticks(range(len(fits)), list(fits))
    axes.set_ylim(len(fits) - 0.4, -0.6)
    axes.set_xlabel(f"{symbol(name)} ({_powers(printed_unit(unit))})")
    clean(axes)


def _intervals(axes: Axes, row: int, fit: Fit, name: str) -> None:
    unit = fit.result.units[name]
    believed = {
        "prior, 95 %": (fit.posterior.prior, 0.8, PRIOR),
        "posterior, 95 %": (fit.card.weighed.estimate, 0.42, ARTERY),
    }
    for label, (gaussian, height, shade) in believed.items():
        low, high = (printed(end, unit) for end in _ends(gaussian, name))
        axes.barh(row, high - low, height, left=low, color=shade, label=label, linewidth=0)
    met = printed(fit.result.estimate[name], unit)
    stroke: Any = {"markersize": 11, "markeredgewidth": 2.2}
    axes.plot(met, row, "|", color=CALIBRATED, label="observations met", **stroke)
    if name in fit.card.truth:
        axes.plot(printed(fit.card.truth[name], unit), row, "D", color=MEASURED, markersize=4, label="truth")


def _ends(gaussian: Gaussian, name: str) -> tuple[float, float]:
    """Where 95 % of a parameter lie, SI."""
    place = gaussian.names.index(name)
    mean, reach = gaussian.mean[place], REACH * gaussian.sd[place]
    return float(np.exp(mean - reach)), float(np.exp(mean + reach))


def _powers(unit: str) -> str:
    return unit.replace("^3", "³")
