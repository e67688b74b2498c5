"""The card of a case: what is believed of each parameter before and after, and how much of it the data say."""

from collections.abc import Iterable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.information import SEEN
from heartfit.tables.card import REACH, Card
from heartfit.tables.figures import ARTERY, CALIBRATED, MEASURED, REFERENCE, clean
from heartfit.tables.text import symbol

EDGE = 4.0
"""Prior standard deviations beyond which a mark is drawn at the edge, as an arrow."""

MET, WEIGHED = CALIBRATED, ARTERY


def plot_cards(cards: Iterable[Card]) -> dict[str, Figure]:
    """The cards by the names of their files."""
    return {f"{card.case}_{card.setting}_card": plot_card(card) for card in cards}


def plot_card(card: Card) -> Figure:
    """Left, each parameter in prior standard deviations: the prior's 95 % grey, the posterior's coloured, the truth.

    Right, the share of the prior's variance that the data took away, direction by direction, from best to least seen.
    """
    count = len(card.prior.names)
    figure = Figure(figsize=(8.0, 1.75 + 0.42 * count), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(3.4, 1))
    draw_parameters(left, card)
    _directions(right, card)
    figure.suptitle(
        f"{card.case}, {card.setting}: the data inform {card.seen.rank} of {count} directions", fontsize=11
    )
    values = ", ".join(f"{value:.2f}" for value in card.met.singular_values)
    least = f"least seen ({100 * card.seen.reduction[-1]:.0f} %): {_mathematics(card)}"
    figure.supxlabel(f"{least}; singular values of Cov(X, Z): {values}", fontsize=8)
    return figure


def draw_parameters(axes: Axes, card: Card) -> None:
    """A row for each parameter, in prior standard deviations: prior, posterior, estimate, truth."""
    rows = np.arange(len(card.prior.names))
    covered = card.covered(card.weighed.estimate)
    axes.barh(rows, 2 * REACH, left=-REACH, height=0.62, color="#e6e6e6", label="prior, 95 %")
    _intervals(axes, card, card.weighed.estimate, WEIGHED, "posterior, 95 %")
    _marks(axes, card.place(card.met.estimate), "|", MET, "observations met")
    _marks(axes, card.true_place(), "D", MEASURED, "truth")
    for row, name in enumerate(card.prior.names):
        verdict = (", covered" if covered[name] else ", missed") if name in covered else ""
        text = f"sd {card.seen.sd_ratio[row]:.2f}{verdict}"
        axes.text(
            EDGE + 0.15,
            row,
            text,
            va="center",
            fontsize=8,
            color=CALIBRATED if "missed" in verdict else "black",
        )
    axes.set_yticks(rows, [symbol(name) for name in card.prior.names])
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.set_xlim(-EDGE - 0.1, EDGE + 0.1)
    axes.set_xlabel("ln of the parameter from the prior's mean (prior sd)", fontsize=9)
    axes.legend(
        loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=4, frameon=False, fontsize=8, columnspacing=1.0
    )
    clean(axes)


def _intervals(axes: Axes, card: Card, estimate: Gaussian, colour: str, label: str) -> None:
    reach = REACH * estimate.sd / card.prior.sd
    ends = np.clip([card.place(estimate) - reach, card.place(estimate) + reach], -EDGE, EDGE)
    rows = np.arange(len(reach))
    axes.barh(rows, ends[1] - ends[0], left=ends[0], height=0.3, color=colour, alpha=0.75, label=label)


def _marks(axes: Axes, places: np.ndarray, marker: str, colour: str, label: str) -> None:
    """Marks, at the edge as arrows where they lie beyond it."""
    rows, known = np.arange(len(places)), np.isfinite(places)
    within = known & (np.abs(places) <= EDGE)
    size = 14 if marker == "|" else 5
    if known.any():
        axes.plot(
            places[within],
            rows[within],
            marker,
            color=colour,
            markersize=size,
            markeredgewidth=2,
            label=label,
        )
    for place, row in zip(places[known & ~within], rows[known & ~within], strict=True):
        axes.plot(np.sign(place) * EDGE, row, ">" if place > 0 else "<", color=colour, markersize=7)


def _directions(axes: Axes, card: Card) -> None:
    seen = card.seen.reduction
    colours = [WEIGHED if share > SEEN else REFERENCE for share in seen]
    axes.barh(np.arange(len(seen)), seen, height=0.62, color=colours)
    axes.axvline(SEEN, color="black", linewidth=0.8, linestyle=":")
    axes.set_yticks(np.arange(len(seen)), [str(place) for place in range(1, len(seen) + 1)])
    axes.set_ylim(len(seen) - 0.5, -0.5)
    axes.set_xlim(0, 1)
    axes.set_xlabel("variance taken away", fontsize=9)
    axes.set_ylabel("direction", fontsize=9)
    axes.set_title(f"worth {card.seen.degrees:.1f} parameters", fontsize=8)
    clean(axes)


def _mathematics(card: Card) -> str:
    """The weakest direction with symbols for names."""
    return " ".join(symbol(word) if word in card.prior.names else word for word in card.weakest().split())
