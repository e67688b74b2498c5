"""Figures as embedded pictures of the page, and the tracks of what moves over them."""

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

from heartfit.core.arrays import Floats
from heartfit.core.layout import lay_out

WIDTH, LEGEND = 11.0, 0.5
"""Width of the page, and height of the legend above the panels [inch]."""


def grid(count: int, columns: int, height: float) -> tuple[Figure, list[Axes]]:
    """Return a figure and ``count`` panels with one y axis, ``columns`` per row; height: of a panel [inch]."""
    across = min(count, columns)
    rows = -(-count // across)
    figure = Figure(figsize=(WIDTH, LEGEND + height * rows), layout="constrained")
    panels = figure.subplots(rows, across, squeeze=False, sharey=True).ravel().tolist()
    for axes in panels[count:]:
        axes.set_axis_off()
    return figure, panels[:count]


def legend(figure: Figure, panels: Sequence[Axes]) -> None:
    """Draw a legend above the panels with each label once."""
    named = {
        label: handle
        for axes in panels
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    figure.legend(
        list(named.values()), list(named), loc="outside upper center", ncols=len(named), frameon=False
    )


TEXT: Any = {"font.size": 9.5, "axes.titlesize": 10.5, "axes.labelsize": 9.5, "legend.fontsize": 9}
SVG: Any = {"svg.hashsalt": "heartfit", "svg.fonttype": "path"}
"""Constant names in the file, and letters as outlines, so that equal figures give equal bytes."""


PATH, LONG = re.compile(rb' (?:d|x|y)="[^"]*"'), re.compile(rb"(\.\d\d)\d+")
PLACE_DIGITS = 5
"""Digits of the position of a panel [figure widths]."""
STILL_WIDTH = 1100
"""Width of a still image [pixels]."""


@dataclass(frozen=True)
class Picture:
    """A figure as data address with alternative text, and the tracks of moving marks [% of its box]."""

    address: str
    alt: str
    follow: Sequence[dict[str, Any]] = ()


def as_picture(figure: Figure, alt: str, follow: Sequence[dict[str, Any]] = ()) -> Picture:
    """Return the figure as SVG; equal figures give equal text."""
    stream = BytesIO()
    fix_layout(figure)
    with mpl.rc_context(SVG):
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    text = base64.b64encode(_rounded(stream.getvalue())).decode("ascii")
    return Picture(f"data:image/svg+xml;base64,{text}", alt, follow)


def still_address(drawn: Image.Image) -> str:
    """Return the data address of an image reduced to the width of the page."""
    stream = BytesIO()
    small = drawn.convert("RGB").resize((STILL_WIDTH, round(STILL_WIDTH * drawn.height / drawn.width)))
    small.save(stream, "WEBP", quality=80)
    return f"data:image/webp;base64,{base64.b64encode(stream.getvalue()).decode('ascii')}"


def _rounded(svg: bytes) -> bytes:
    """Return the SVG with paths and places rounded to a hundredth of a point, which halves its size."""
    return PATH.sub(lambda path: LONG.sub(rb"\1", path[0]), svg)


def fix_layout(figure: Figure) -> None:
    """Lay the figure out once and round the layout: the last digits of the solver change between calls."""
    if figure.get_layout_engine() is None:
        return
    lay_out(figure)
    for part in figure.subfigs:
        part.bbox_relative.set_points(np.round(part.bbox_relative.get_points(), PLACE_DIGITS))
    for axes in figure.axes:
        axes.set_position(np.round(axes.get_position().bounds, PLACE_DIGITS).tolist())


def time_line_track(axes: Axes, times: Floats) -> dict[str, Any]:
    """Return the place of a vertical line in a panel over time at each of the times; needs a fixed layout."""
    low, high = axes.get_position().intervaly
    x, _ = _percent(axes, np.column_stack([times, np.zeros(len(times))]))
    return {"x": x, "top": round(100 * (1 - high), 2), "bottom": round(100 * (1 - low), 2)}


def dot_track(axes: Axes, points: Floats, colour: str) -> dict[str, Any]:
    """Return the place of a dot in a panel at each of the points (p, 2); needs a fixed layout."""
    x, y = _percent(axes, points)
    return {"x": x, "y": y, "colour": colour}


def _percent(axes: Axes, points: Floats) -> tuple[list[float], list[float]]:
    figure = axes.figure
    share = figure.transFigure.inverted().transform(axes.transData.transform(points))
    return np.round(100 * share[:, 0], 2).tolist(), np.round(100 * (1 - share[:, 1]), 2).tolist()
