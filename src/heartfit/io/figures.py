"""Figures and animations, written in the format of their suffix."""

from collections.abc import Mapping
from pathlib import Path

from matplotlib.animation import FuncAnimation
from matplotlib.figure import Figure

from heartfit.core.layout import lay_out
from heartfit.io.files import replacing


def write_figures(folder: Path, figures: Mapping[str, Figure]) -> None:
    """Write each figure by its name as PNG and PDF."""
    for name, figure in figures.items():
        for suffix in ("png", "pdf"):
            write_figure(Path(folder, f"{name}.{suffix}"), figure)


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
