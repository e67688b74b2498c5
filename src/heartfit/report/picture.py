"""A figure inside a page: SVG as a data address, what it shows in words, and where time runs in it."""

import base64
import re
from collections.abc import Sequence
from dataclasses import dataclass
from io import BytesIO
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from PIL import Image

from heartfit.geometry.arrays import Floats

TEXT: Any = {"font.size": 9.5, "axes.titlesize": 10.5, "axes.labelsize": 9.5, "legend.fontsize": 9}
SVG: Any = {"svg.hashsalt": "heartfit", "svg.fonttype": "path"}
"""Names within the file that do not change from run to run, and letters as outlines, the same everywhere."""


PATH, LONG = re.compile(rb' (?:d|x|y)="[^"]*"'), re.compile(rb"(\.\d\d)\d+")
DIGITS = 5
"""Of the place of a panel, in widths of its figure."""
STILL = 1100
"""Pixels across."""


@dataclass(frozen=True)
class Picture:
    """address: the figure as data; alt: what it shows; follow: what moves over it with time, in percent of its box."""

    address: str
    alt: str
    follow: Sequence[dict[str, Any]] = ()


def picture(figure: Figure, alt: str, follow: Sequence[dict[str, Any]] = ()) -> Picture:
    """The figure as SVG; the same figure gives the same text."""
    stream = BytesIO()
    settle(figure)
    with mpl.rc_context(SVG):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    text = base64.b64encode(_rounded(stream.getvalue())).decode("ascii")
    return Picture(f"data:image/svg+xml;base64,{text}", alt, follow)


def still(drawn: Image.Image) -> str:
    """The address, as data, of a picture made small enough for a page."""
    stream = BytesIO()
    small = drawn.convert("RGB").resize((STILL, round(STILL * drawn.height / drawn.width)))
    small.save(stream, "WEBP", quality=80)
    return f"data:image/webp;base64,{base64.b64encode(stream.getvalue()).decode('ascii')}"


def _rounded(svg: bytes) -> bytes:
    """Paths and places to a hundredth of a point, which halves them."""
    return PATH.sub(lambda path: LONG.sub(rb"\1", path[0]), svg)


def settle(figure: Figure) -> None:
    """Lay the figure out, once and to what a page can show: the solver's last digits change from call to call."""
    if figure.get_layout_engine() is None:
        return
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    for part in figure.subfigs:
        part.bbox_relative.set_points(np.round(part.bbox_relative.get_points(), DIGITS))
    for axes in figure.axes:
        axes.set_position(np.round(axes.get_position().bounds, DIGITS).tolist())


def line_of_time(axes: Axes, times: Floats) -> dict[str, Any]:
    """Where a vertical line stands in a panel over time at each of the times, in its units; the figure is laid out."""
    low, high = axes.get_position().intervaly
    x, _ = _percent(axes, np.column_stack([times, np.zeros(len(times))]))
    return {"x": x, "top": round(100 * (1 - high), 2), "bottom": round(100 * (1 - low), 2)}


def rider(axes: Axes, points: Floats, colour: str) -> dict[str, Any]:
    """Where a dot stands in a panel at each of the points (p, 2), in its units; the figure is laid out."""
    x, y = _percent(axes, points)
    return {"x": x, "y": y, "colour": colour}


def _percent(axes: Axes, points: Floats) -> tuple[list[float], list[float]]:
    figure = axes.figure
    share = figure.transFigure.inverted().transform(axes.transData.transform(points))
    return np.round(100 * share[:, 0], 2).tolist(), np.round(100 * (1 - share[:, 1]), 2).tolist()
