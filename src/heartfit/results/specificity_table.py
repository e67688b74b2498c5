"""Differences between patients and volunteers with exact p, their information, and the claims of the paper."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter, ScalarFormatter

from heartfit.calibration.gaussian import INFORMED_SHARE
from heartfit.results.case import DILATED
from heartfit.results.figures import ARTERY, CALIBRATED, clean
from heartfit.results.specificity import READINGS, STANDS_FOR, PatientComparison
from heartfit.results.text import LONG_STEPS, printed_steps, symbol

STIFFNESS = (*STANDS_FOR, *STANDS_FOR.values())
Row = dict[str, Any]


@dataclass(frozen=True)
class ClaimedLimits:
    """Claims of the paper over its healthy mean: contractility of both patients below, stiffness of case 2 above."""

    weak: float
    stiff: float

    def of(self, parameter: str) -> float | None:
        """Return the limit of an estimated parameter, None without one."""
        return self.weak if parameter == "sigma_0" else self.stiff if parameter in STIFFNESS else None


def specificity_table(comparisons: Sequence[PatientComparison]) -> pd.DataFrame:
    """Return one row per setting, parameter and reading: each patient over the healthy mean, and the exact test.

    "difference" is in prior standard deviations; p is two-sided over all labelings, "least p" the smallest possible p;
    "variance reduction" is the share of the prior variance of the difference that the data remove; for all parameters
    together it is the share of the squared difference in informed directions. Below one half there is a warning.
    """
    rows = [(*_parameter_rows(comparison), *_joint_rows(comparison)) for comparison in comparisons]
    return pd.DataFrame(chain.from_iterable(rows))


def specificity_claims(comparisons: Sequence[PatientComparison], limits: ClaimedLimits) -> pd.DataFrame:
    """Return both claims of the paper, one row per setting and reading: deciding ratio, limit, one-sided p."""
    rows = [
        (*_weak_claims(comparison, limits), *_stiff_claims(comparison, limits)) for comparison in comparisons
    ]
    return pd.DataFrame(chain.from_iterable(rows))


def _parameter_rows(comparison: PatientComparison) -> Iterable[Row]:
    for place, name in enumerate(comparison.names):
        informed = 1.0 - float(comparison.information.sd_ratio[place]) ** 2
        for reading in READINGS:
            ratios = comparison.ratios(reading, name)
            if ratios:
                test = comparison.test(reading, name)
                yield {
                    "setting": comparison.setting,
                    "parameter": name,
                    "reading": reading,
                    **{f"{card.case} over healthy": ratios[card.case] for card in comparison.patients},
                    "difference": test.difference
                    / float(np.sqrt(comparison.patients[0].prior.marginal([name]).covariance[0, 0])),
                    "p": test.p,
                    "least p": 1.0 / test.labelings,
                    "variance reduction": informed,
                    "warning": _warning(informed),
                    LONG_STEPS: printed_steps(comparison.long_steps(reading, name)),
                }


def _joint_rows(comparison: PatientComparison) -> Iterable[Row]:
    for reading in READINGS:
        if all(comparison.ratios(reading, name) for name in comparison.names):
            difference = comparison.difference(reading)
            informed = comparison.information.share(difference)
            yield {
                "setting": comparison.setting,
                "parameter": "all",
                "reading": reading,
                "difference": float(np.linalg.norm(difference)),
                "variance reduction": informed,
                "warning": _warning(informed),
                LONG_STEPS: "",
            }


def _warning(informed: float) -> str:
    return "" if informed >= INFORMED_SHARE else "dominated by the prior"


def _weak_claims(comparison: PatientComparison, limits: ClaimedLimits) -> Iterable[Row]:
    if "sigma_0" in comparison.names:
        names = [card.case for card in comparison.patients]
        for reading in READINGS:
            ratios, test = comparison.ratios(reading, "sigma_0"), comparison.test(reading, "sigma_0")
            worst = max(ratios[case] for case in names)
            claim = f"sigma_0 of {' and '.join(names)} below"
            steps = comparison.long_steps(reading, "sigma_0")
            holds = worst < limits.weak
            yield _claim_row(
                comparison, claim, reading, worst, limits.weak, holds, test.less, test.labelings, steps
            )


def _stiff_claims(comparison: PatientComparison, limits: ClaimedLimits) -> Iterable[Row]:
    name = next((name for name in STIFFNESS if name in comparison.names), None)
    if name and DILATED in [card.case for card in comparison.patients]:
        for reading in READINGS:
            ratio, test = comparison.ratios(reading, name)[DILATED], comparison.test(reading, name, [DILATED])
            claim = f"{name} of {DILATED} above"
            yield _claim_row(
                comparison,
                claim,
                reading,
                ratio,
                limits.stiff,
                ratio >= limits.stiff,
                test.greater,
                test.labelings,
                comparison.long_steps(reading, name),
            )


def _claim_row(
    comparison: PatientComparison,
    claim: str,
    reading: str,
    ratio: float,
    limit: float,
    holds: bool,
    p: float,
    labelings: int,
    steps: Mapping[str, float],
) -> Row:
    return {
        "setting": comparison.setting,
        "claim": claim,
        "reading": reading,
        "over healthy": ratio,
        "limit": limit,
        "holds": "holds" if holds else "does not hold",
        "p": p,
        "least p": 1.0 / labelings,
        LONG_STEPS: printed_steps(steps),
    }


MARKERS = ("^", "s", "v", "D")
LABELS = {
    "noise-free": "noise-\nfree",
    "noise-aware": "noise-\naware",
    "unshrunk": "unshrunk",
    "truth": "truth",
}
TICKS = (0.5, 0.7, 1.0, 1.4, 2.0)


def plot_specificity(comparisons: Sequence[PatientComparison], limits: ClaimedLimits) -> Figure:
    """Plot the ratios to the healthy mean, one row per setting, one panel per parameter estimated in all cases.

    Each panel has one column per reading with the exact p. A grey panel marks a difference that the data hardly
    inform; the dotted line is the claim of the paper.
    """
    columns = max((len(comparison.names) for comparison in comparisons), default=1)
    rows = max(len(comparisons), 1)
    figure = Figure(figsize=(2.6 * columns + 0.6, 2.7 * rows + 0.4), layout="constrained")
    panels = figure.subplots(rows, columns, squeeze=False, sharey=True)
    for axes in panels.ravel():
        axes.set_visible(False)
    for comparison, row in zip(comparisons, panels, strict=False):
        for name, axes in zip(comparison.names, row, strict=False):
            axes.set_visible(True)
            _draw_panel(axes, comparison, name, limits.of(name))
        row[0].set_ylabel(f"{comparison.setting}\nratio to the healthy mean", fontsize=9)
    if comparisons:
        handles, labels = panels[0, 0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="outside upper center", ncols=6, frameon=False, fontsize=9)
    return figure


def _draw_panel(axes: Axes, comparison: PatientComparison, name: str, limit: float | None) -> None:
    for place, reading in enumerate(READINGS):
        ratios = comparison.ratios(reading, name)
        if ratios:
            _draw_reading(axes, comparison, place, ratios)
            axes.text(
                place, 1.01, f"p {comparison.test(reading, name).p:.2f}", transform=axes.get_xaxis_transform(),
                ha="center", va="bottom", fontsize=7,
            )  # fmt: skip
    informed = 1.0 - float(comparison.information.sd_ratio[comparison.names.index(name)]) ** 2
    if informed < INFORMED_SHARE:
        axes.set_facecolor("#e9e9e9")
    stands = f" (truth: {symbol(STANDS_FOR[name])})" if name in STANDS_FOR else ""
    axes.set_title(f"{symbol(name)}{stands}, informed {100 * informed:.0f} %", fontsize=9, pad=14)
    if limit is not None:
        axes.axhline(limit, color=CALIBRATED, linewidth=0.9, linestyle=":")
    _scale_axes(axes)


def _draw_reading(axes: Axes, comparison: PatientComparison, place: int, ratios: dict[str, float]) -> None:
    healthy = [ratios[card.case] for card in comparison.volunteers]
    first = place == 0
    axes.plot(
        [place] * len(healthy), healthy, "o", color=ARTERY, alpha=0.55, markersize=5, markeredgewidth=0,
        label="volunteers" if first else None,
    )  # fmt: skip
    offsets = np.linspace(-0.15, 0.15, len(comparison.patients))
    for card, marker, offset in zip(comparison.patients, MARKERS, offsets, strict=False):
        axes.plot(
            place + offset, ratios[card.case], marker, color=CALIBRATED, markersize=6.5, markeredgecolor="black",
            markeredgewidth=0.6, linestyle="none", label=card.case if first else None,
        )  # fmt: skip


def _scale_axes(axes: Axes) -> None:
    axes.axhline(1.0, color="black", linewidth=0.6)
    axes.set_yscale("log")
    low, high = axes.get_ylim()
    axes.set_ylim(min(low, 0.48), max(high, 2.1))
    axes.set_yticks(TICKS)
    axes.yaxis.set_major_formatter(ScalarFormatter())
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.set_xticks(range(len(READINGS)), [LABELS[reading] for reading in READINGS], fontsize=7)
    axes.set_xlim(-0.5, len(READINGS) - 0.5)
    axes.tick_params(axis="y", labelsize=8)
    clean(axes)
