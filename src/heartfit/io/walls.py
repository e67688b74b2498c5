"""Searches with the strain of the wall: wall.json with the verdict, the card and its bull's-eye."""

from pathlib import Path

from heartfit.io.figures import write_figure
from heartfit.io.files import write_text
from heartfit.io.results import read_record, write_result
from heartfit.results.wall_card import RenderedWall
from heartfit.results.wall_summary import WallSummary

RESULT, CARD, FIGURE = "wall.json", "wall.md", "wall.png"


def write_wall(folder: Path, rendered: RenderedWall, fingerprint: str) -> None:
    """Write wall.json, wall.md, and wall.png if an effect of a region was fitted."""
    write_result(folder / RESULT, rendered.summary, fingerprint)
    write_text(folder / CARD, rendered.card)
    if rendered.figure is not None:
        write_figure(folder / FIGURE, rendered.figure)


def read_wall(folder: Path) -> WallSummary:
    """Read the summary of wall.json; raises InputError for a missing or broken file."""
    return read_record(folder / RESULT, WallSummary)
