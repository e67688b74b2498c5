"""Search with the strain of the wall on the page."""

from dataclasses import dataclass

from heartfit.discovery.wall_model.search import RULES
from heartfit.results.report.picture import WIDTH, Picture, as_picture
from heartfit.results.wall_card import UNSEEN, wall_figure
from heartfit.results.wall_summary import WallSummary


@dataclass(frozen=True)
class WallCard:
    """A summary with its title, its bull's-eye if it has one, a note on unseen effects, and the threshold."""

    title: str
    summary: WallSummary
    figure: Picture | None
    note: str = UNSEEN
    threshold: float = RULES.detected


def wall_section(setting: str, summary: WallSummary) -> WallCard:
    """Return the part of a setting's search."""
    figure = wall_figure(summary)
    if figure is None:
        return WallCard(f"{setting}: search with the strain of the wall", summary, None)
    figure.set_size_inches(0.5 * WIDTH, figure.get_figheight())
    picture = as_picture(figure, f"Bull's-eye of the segments of the {summary.effect}. {summary.sentence}")
    return WallCard(f"{setting}: search with the strain of the wall", summary, picture)
