"""Card and bull's-eye of a search with the strain of the wall."""

from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from heartfit.discovery.wall_model.search import RULES, WallFindings
from heartfit.results.bullseye import plot_bullseye
from heartfit.results.wall_summary import NAMES, WallSummary, summarise_wall

LEAST_SHOWN = 0.05
"""Least probability of a segment in the table."""
UNSEEN = (
    "Effects that are not named would be from these sizes, by the linear model; an effect of a region where it shows "
    "most and where it shows least."
)


@dataclass(frozen=True, eq=False)
class RenderedWall:
    """A search of a wall with its card as Markdown and its bull's-eye, None without an effect of a region."""

    summary: WallSummary
    card: str
    figure: Figure | None


def render_wall(findings: WallFindings, title: str) -> RenderedWall:
    """Return summary, card and bull's-eye of a search."""
    summary = summarise_wall(findings, title)
    return RenderedWall(summary, wall_card(summary), wall_figure(summary))


def wall_card(summary: WallSummary) -> str:
    """Return the card as Markdown."""
    parts = [f"# {summary.title}", summary.sentence, _evidence(summary)]
    if summary.named:
        parts.append(_segments(summary))
    if summary.unseen:
        parts.append(_unseen(summary))
    return "\n\n".join(parts) + "\n"


def wall_figure(summary: WallSummary) -> Figure | None:
    """Return the bull's-eye of the best effect of a region, None if none was fitted."""
    if not summary.effect:
        return None
    label = "probability of a segment, if it is present"
    return plot_bullseye([(summary.effect, np.asarray(summary.probability))], label)


def _evidence(summary: WallSummary) -> str:
    rows = [f"| {explanation} | {gain:.1f} |" for explanation, gain in summary.evidence.items()]
    return "\n".join(
        [f"| explanation | ln Bayes factor (threshold {RULES.detected:g}) |", "|---|---|", *rows]
    )


def _segments(summary: WallSummary) -> str:
    rows = [
        f"| {place + 1} | {NAMES[place]} | {value:.2f} |"
        for place, value in enumerate(summary.probability)
        if value >= LEAST_SHOWN
    ]
    return "\n".join(["| segment | wall | probability |", "|---|---|---|", *rows])


def _unseen(summary: WallSummary) -> str:
    rows = [
        f"| {one.name} | {one.meaning} | {one.most_visible} | {one.least_visible} |" for one in summary.unseen
    ]
    head = ["| not seen | size | from | from, where it shows least |", "|---|---|---|---|"]
    return "\n".join([UNSEEN, "", *head, *rows])
