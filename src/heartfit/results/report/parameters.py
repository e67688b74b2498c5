"""Parameters of all cases: prior, estimate with its interval, parameters of the calibrated beat, and truth.

The estimate is the noise-aware one. On spheres of known parameters its 95 % intervals contained the truth about as
often as they should, those of an exact fit less often (table coverage_sphere of config/full.yaml). The calibrated beat
has the parameters of `posterior.json`, as in the paper.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.calibration.gaussian import INFORMED_SHARE, Gaussian
from heartfit.core.parameter import printed_unit, to_printed_unit
from heartfit.results.card import INTERVAL_REACH
from heartfit.results.card_figure import AXIS_LIMIT, PRIOR, SECONDARY, draw_parameters
from heartfit.results.figures import MEASURED, clean
from heartfit.results.report.picture import TEXT, WIDTH, Picture, as_picture, grid, legend
from heartfit.results.report.record import CaseRecord, FittedCase
from heartfit.results.text import symbol

COLUMNS, PANEL_HEIGHT, ROW_HEIGHT, LEGEND = 4, 0.9, 0.24, 26
"""Panels per row; height of a panel without cases and of each case [inch]; height of a line of legend [points]."""


@dataclass(frozen=True)
class Estimate:
    """Estimate of a parameter in its printed unit: median, 95 % interval, and median of the prior.

    reduction: share of the prior variance that the data remove; beat: value of the calibrated beat; truth: NaN without
    one.
    """

    name: str
    unit: str
    median: float
    low: float
    high: float
    prior: float
    reduction: float
    beat: float
    truth: float

    @property
    def informed(self) -> bool:
        """Return if the data removed more than half of the prior variance."""
        return self.reduction > INFORMED_SHARE

    @property
    def holds_beat(self) -> bool:
        """Return if the interval contains the value of the calibrated beat."""
        return self.low <= self.beat <= self.high


def estimates(fit: FittedCase) -> Iterator[Estimate]:
    """Yield the estimate of each parameter of a fit."""
    card, estimate = fit.card, fit.card.noise_aware.estimate
    medians, priors = estimate.physical(), card.prior.physical()
    for name, ratio in zip(card.prior.names, card.information.sd_ratio, strict=True):
        unit = fit.result.units[name]
        values = (
            medians[name], *_interval(estimate, name), priors[name], fit.result.estimate[name],
            card.truth.get(name, math.nan),
        )  # fmt: skip
        median, low, high, prior, beat, truth = (to_printed_unit(value, unit) for value in values)
        reduction = 1.0 - float(ratio) ** 2
        yield Estimate(name, printed_unit(unit), median, low, high, prior, reduction, beat, truth)


def plot_parameters(cases: Sequence[CaseRecord], setting: str, colour: str) -> Picture:
    """Plot one panel per parameter with one row per case of the setting; colour: of the setting."""
    fits = {case.name: case.fits[setting] for case in cases if setting in case.fits}
    names = list(dict.fromkeys(name for fit in fits.values() for name in fit.result.estimate))
    with rc_context(TEXT):
        figure, panels = grid(len(names), COLUMNS, PANEL_HEIGHT + ROW_HEIGHT * len(fits))
        for axes, name in zip(panels, names, strict=True):
            _panel(axes, fits, name, colour)
        legend(figure, panels)
        return as_picture(figure, f"{', '.join(names)} of each case, setting {setting}, with the prior")


def plot_estimates(case: CaseRecord, cases: Sequence[CaseRecord], colours: Mapping[str, str]) -> Picture:
    """Plot all parameters of a case in prior standard deviations with the cohort as dots, one panel per setting.

    colours: of the settings.
    """
    rows = max(len(fit.card.prior.names) for fit in case.fits.values())
    with rc_context(TEXT):
        figure = Figure(figsize=(WIDTH, PANEL_HEIGHT + 2 * ROW_HEIGHT * (1 + rows)), layout="constrained")
        for axes, (setting, fit) in zip(
            figure.subplots(1, len(case.fits), squeeze=False)[0], case.fits.items(), strict=True
        ):
            draw_parameters(axes, fit.card, colours[setting])
            _others(
                axes,
                fit,
                [other.fits[setting] for other in cases if other is not case and setting in other.fits],
            )
            axes.set_title(setting, pad=LEGEND)
        return as_picture(figure, f"Parameters of {case.name} with the prior and the cohort")


def _others(axes: Axes, fit: FittedCase, others: Sequence[FittedCase]) -> None:
    """Plot the estimates of other cases, in the prior of this case."""
    prior = fit.card.prior
    for row, name in enumerate(prior.names):
        logs = [np.log(other.result.estimate[name]) for other in others if name in other.result.estimate]
        places = (np.array(logs) - prior.mean[row]) / prior.sd[row]
        within = places[np.abs(places) <= AXIS_LIMIT]
        axes.plot(within, np.full(len(within), row + 0.39), ".", color="#666666", markersize=4)


def _panel(axes: Axes, fits: Mapping[str, FittedCase], name: str, colour: str) -> None:
    unit = next(fit.result.units[name] for fit in fits.values() if name in fit.result.units)
    for row, fit in enumerate(fits.values()):
        if name in fit.result.estimate:
            _intervals(axes, row, fit, name, colour)
        else:
            across = axes.get_yaxis_transform()
            axes.text(
                0.03, row, "not estimated", transform=across, va="center", fontsize=7.5, color="#555555"
            )
    axes.set_yticks(range(len(fits)), list(fits))
    axes.set_ylim(len(fits) - 0.4, -0.6)
    axes.set_xlabel(f"{symbol(name)} ({_superscript(printed_unit(unit))})")
    clean(axes)


def _intervals(axes: Axes, row: int, fit: FittedCase, name: str, colour: str) -> None:
    unit = fit.result.units[name]
    gaussians = {
        "prior, 95 %": (fit.posterior.prior, 0.8, PRIOR),
        "estimate, 95 %": (fit.card.noise_aware.estimate, 0.42, colour),
    }
    for label, (gaussian, height, shade) in gaussians.items():
        low, high = (to_printed_unit(end, unit) for end in _interval(gaussian, name))
        axes.barh(row, high - low, height, left=low, color=shade, label=label, linewidth=0)
    median = to_printed_unit(fit.card.noise_aware.estimate.physical()[name], unit)
    axes.plot(median, row, "o", color=colour, markersize=5, markeredgecolor="white")
    beat = to_printed_unit(fit.result.estimate[name], unit)
    stroke: Any = {"markersize": 11, "markeredgewidth": 2.2}
    axes.plot(beat, row, "|", color=SECONDARY, label="calibrated beat", **stroke)
    if name in fit.card.truth:
        axes.plot(
            to_printed_unit(fit.card.truth[name], unit), row, "D", color=MEASURED, markersize=4, label="truth"
        )


def _interval(gaussian: Gaussian, name: str) -> tuple[float, float]:
    """Return the 95 % interval of a parameter, SI."""
    place = gaussian.names.index(name)
    mean, reach = gaussian.mean[place], INTERVAL_REACH * gaussian.sd[place]
    return float(np.exp(mean - reach)), float(np.exp(mean + reach))


def _superscript(unit: str) -> str:
    return unit.replace("^3", "³")
