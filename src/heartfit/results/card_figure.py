"""Card of a case as a figure: prior, posteriors and truth of each parameter, and the informed directions."""

from collections.abc import Iterable, Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.calibration.gaussian import INFORMED_SHARE, Gaussian
from heartfit.results.card import INTERVAL_REACH, Card
from heartfit.results.figures import CALIBRATED, MEASURED, REFERENCE, clean
from heartfit.results.text import LONG_STEP_LEGEND, LONG_STEP_MARK, symbol

AXIS_LIMIT = 4.0
"""Prior standard deviations; marks beyond are arrows at the edge."""

PRIOR, SECONDARY = "#e6e6e6", "#333333"
"""Colours of the prior, and of the parameters of the calibrated beat: the noise-free estimate as in the paper."""


def plot_cards(cards: Iterable[Card], colours: Mapping[str, str]) -> dict[str, Figure]:
    """Return the cards by file name; colours: of the settings."""
    return {f"{card.case}_{card.setting}_card": plot_card(card, colours[card.setting]) for card in cards}


def plot_card(card: Card, colour: str) -> Figure:
    """Plot the parameters in prior standard deviations, and the share of the prior variance that the data remove.

    Left: 95 % of the prior in grey, 95 % of the noise-aware estimate in the colour of the setting, and the truth.
    Right: one bar per direction, from the best informed to the least informed.
    """
    count = len(card.prior.names)
    figure = Figure(figsize=(8.0, 1.75 + 0.42 * count), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(3.4, 1))
    draw_parameters(left, card, colour)
    _directions(right, card, colour)
    figure.suptitle(
        f"{card.case}, {card.setting}: {card.information.rank} of {count} directions informed by the data",
        fontsize=11,
    )
    values = ", ".join(f"{value:.2f}" for value in card.noise_free.singular_values)
    least = f"least informed ({100 * card.information.reduction[-1]:.0f} %): {_weakest_direction(card)}"
    legend = f"; {LONG_STEP_MARK} {LONG_STEP_LEGEND}" if card.long_steps(card.noise_free.estimate) else ""
    figure.supxlabel(f"{least}\nsingular values of Cov(X, Z): {values}{legend}", fontsize=8)
    return figure


def draw_parameters(axes: Axes, card: Card, colour: str) -> None:
    """Draw one row per parameter in prior standard deviations: prior, estimate, calibrated beat, truth.

    The estimate is the noise-aware one, in this colour.
    """
    rows = np.arange(len(card.prior.names))
    covered = card.covered(card.noise_aware.estimate)
    axes.barh(rows, 2 * INTERVAL_REACH, left=-INTERVAL_REACH, height=0.62, color=PRIOR, label="prior, 95 %")
    _intervals(axes, card, card.noise_aware.estimate, colour, "estimate, 95 %")
    _marks(axes, card.place(card.noise_aware.estimate), "o", colour, "_")
    _marks(axes, card.place(card.noise_free.estimate), "|", SECONDARY, "calibrated beat")
    _marks(axes, card.true_place(), "D", MEASURED, "truth")
    for row, name in enumerate(card.prior.names):
        verdict = (", covered" if covered[name] else ", missed") if name in covered else ""
        text = f"sd {card.information.sd_ratio[row]:.2f}{verdict}"
        axes.text(
            AXIS_LIMIT + 0.15,
            row,
            text,
            va="center",
            fontsize=8,
            color=CALIBRATED if "missed" in verdict else "black",
        )
    long = card.long_steps(card.noise_free.estimate)
    marks = [f" {LONG_STEP_MARK}" if name in long else "" for name in card.prior.names]
    axes.set_yticks(
        rows, [f"{symbol(name)}{mark}" for name, mark in zip(card.prior.names, marks, strict=True)]
    )
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xlim(-AXIS_LIMIT - 0.1, AXIS_LIMIT + 0.1)
    axes.set_xlabel("ln parameter − prior mean (prior sd)", fontsize=9)
    axes.legend(
        loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4, frameon=False, fontsize=8, columnspacing=1.0,
        reverse=True,
    )  # fmt: skip
    clean(axes)


def _intervals(axes: Axes, card: Card, estimate: Gaussian, colour: str, label: str) -> None:
    reach = INTERVAL_REACH * estimate.sd / card.prior.sd
    ends = np.clip([card.place(estimate) - reach, card.place(estimate) + reach], -AXIS_LIMIT, AXIS_LIMIT)
    rows = np.arange(len(reach))
    axes.barh(rows, ends[1] - ends[0], left=ends[0], height=0.3, color=colour, alpha=0.75, label=label)


def _marks(axes: Axes, places: np.ndarray, marker: str, colour: str, label: str) -> None:
    """Draw marks, as arrows at the edge for places beyond it."""
    rows, finite = np.arange(len(places)), np.isfinite(places)
    within = finite & (np.abs(places) <= AXIS_LIMIT)
    size = 14 if marker == "|" else 5
    if finite.any():
        axes.plot(
            places[within],
            rows[within],
            marker,
            color=colour,
            markersize=size,
            markeredgewidth=2,
            markeredgecolor="white" if marker == "o" else colour,
            label=label,
        )
    for place, row in zip(places[finite & ~within], rows[finite & ~within], strict=True):
        axes.plot(np.sign(place) * AXIS_LIMIT, row, ">" if place > 0 else "<", color=colour, markersize=7)


def _directions(axes: Axes, card: Card, colour: str) -> None:
    reduction = card.information.reduction
    colours = [colour if share > INFORMED_SHARE else REFERENCE for share in reduction]
    axes.barh(np.arange(len(reduction)), reduction, height=0.62, color=colours)
    axes.axvline(INFORMED_SHARE, color="black", linewidth=0.8, linestyle=":")
    axes.set_yticks(np.arange(len(reduction)), [str(place) for place in range(1, len(reduction) + 1)])
    axes.set_ylim(len(reduction) - 0.5, -0.5)
    axes.set_xlim(0, 1)
    axes.set_xlabel("prior variance removed", fontsize=9)
    axes.set_ylabel("direction", fontsize=9)
    axes.set_title(f"{card.information.degrees:.1f} effective parameters", fontsize=8)
    clean(axes)


def _weakest_direction(card: Card) -> str:
    """Return the least informed direction with symbols for names."""
    return " ".join(symbol(word) if word in card.prior.names else word for word in card.weakest().split())
