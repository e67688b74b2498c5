"""Figures and animations, written in the format of their suffix."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from matplotlib.animation import FuncAnimation
from matplotlib.figure import Figure

from heartfit.core.layout import lay_out
from heartfit.io.files import replacing


def write_figures(files: Iterable[str], figures: Mapping[str, Figure]) -> None:
    """Write each file with the figure of its name, in the format of its suffix."""
    for file in map(Path, files):
        write_figure(file, figures[file.stem])


def write_figure(path: Path, figure: Figure) -> None:
    """Write in the format of the suffix (png, pdf, svg), without a date, so that equal figures have equal bytes.

    The figure keeps the layout of the first format for the next one.
    """
    lay_out(figure)
    date = {"png": "Software", "pdf": "CreationDate", "svg": "Date"}.get(Path(path).suffix[1:])
    with replacing(path) as draft:
        figure.savefig(draft, dpi=200, metadata={date: None} if date else None)


ANIMATION_SUFFIXES = (".gif", ".png")


def write_animation(path: Path, animation: FuncAnimation) -> None:
    """Write an animated GIF, or PNG in full colour; raises ValueError for another suffix.

    The delays of a GIF are whole hundredths of a second.
    """
    if Path(path).suffix not in ANIMATION_SUFFIXES:
        raise ValueError(f"{path}: animations are written as {', '.join(ANIMATION_SUFFIXES)}")
    with replacing(path) as draft:
        animation.save(draft, writer="pillow")
