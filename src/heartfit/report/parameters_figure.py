"""Every parameter of everybody: the prior, the posterior, the estimate whose beat is shown, and the truth."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes

from heartfit.calibration.gaussian import Gaussian
from heartfit.report.grid import grid, legend
from heartfit.report.picture import TEXT, Picture, picture
from heartfit.report.record import CaseRecord, Fit
from heartfit.tables.card import REACH
from heartfit.tables.display import printed, printed_unit
from heartfit.tables.figures import ARTERY, CALIBRATED, MEASURED, clean
from heartfit.tables.text import symbol

COLUMNS, HEAD, ROW = 4, 0.9, 0.24
"""Panels in a row; inches of a panel beside its cases, and of each case."""
PRIOR, FAINT = "#dddddd", 0.35


def plot_parameters(cases: Sequence[CaseRecord], setting: str, marked: str = "") -> Picture:
    """One panel for each parameter, one row in it for each case; ``marked`` stands out of its cohort."""
    fits = {case.name: case.fits[setting] for case in cases}
    names = list(dict.fromkeys(name for fit in fits.values() for name in fit.result.estimate))
    with rc_context(TEXT):
        figure, panels = grid(len(names), COLUMNS, HEAD + ROW * len(fits))
        for axes, name in zip(panels, names, strict=True):
            _panel(axes, fits, name, marked)
        legend(figure, panels)
        return picture(figure, f"{', '.join(names)} of each case, setting {setting}, beside the prior")


def _panel(axes: Axes, fits: Mapping[str, Fit], name: str, marked: str) -> None:
    unit = next(fit.result.units[name] for fit in fits.values() if name in fit.result.units)
    for row, (case, fit) in enumerate(fits.items()):
        if name in fit.result.estimate:
            _intervals(axes, row, fit, name, 1.0 if marked in ("", case) else FAINT)
        else:
            across = axes.get_yaxis_transform()
            axes.text(
                0.03, row, "not estimated", transform=across, va="center", fontsize=7.5, color="#555555"
            )
    axes.set_yticks(range(len(fits)), list(fits))
    axes.set_ylim(len(fits) - 0.4, -0.6)
    axes.set_xlabel(f"{symbol(name)} ({_powers(printed_unit(unit))})")
    clean(axes)


def _intervals(axes: Axes, row: int, fit: Fit, name: str, strength: float) -> None:
    unit = fit.result.units[name]
    believed = {
        "prior, 95 %": (fit.posterior.prior, 0.8, PRIOR, 1.0),
        "posterior, 95 %": (fit.card.weighed.estimate, 0.42, ARTERY, strength),
    }
    for label, (gaussian, height, shade, alpha) in believed.items():
        low, high = (printed(end, unit) for end in _ends(gaussian, name))
        axes.barh(row, high - low, height, left=low, color=shade, alpha=alpha, label=label, linewidth=0)
    met = printed(fit.result.estimate[name], unit)
    stroke: Any = {"markersize": 11, "markeredgewidth": 2.2, "alpha": max(strength, 0.5)}
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
