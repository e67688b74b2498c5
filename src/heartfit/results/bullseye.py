"""The bull's-eye of the seventeen AHA segments, base outside and apex at the centre."""

from collections.abc import Sequence

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes

from heartfit.core.arrays import Floats
from heartfit.geometry.territory import APEX, APICAL, BASAL

RINGS = ((3.0, 4.0, BASAL), (2.0, 3.0, BASAL + 6), (1.0, 2.0, APICAL))
"""Inner and outer radius of each ring, and its segments in turn from the middle of the septum towards anterior."""
SEPTUM = np.pi
"""Direction of the middle of the septum in the figure, at the left as in a short-axis image; anterior is above."""


COLOURS, DARK = "Reds", 0.6
"""Colour map, and the value above which numbers are white."""


def plot_bullseye(panels: Sequence[tuple[str, Floats]], label: str) -> Figure:
    """Draw one bull's-eye for each titled array (17,) of numbers between 0 and 1."""
    figure = Figure(figsize=(3.0 * len(panels) + 0.9, 3.7), layout="constrained")
    axes = figure.subplots(1, len(panels), subplot_kw={"projection": "polar"}, squeeze=False)[0]
    scale = ScalarMappable(Normalize(0.0, 1.0), COLOURS)
    for panel, (title, values) in zip(axes, panels, strict=True):
        _draw(panel, values, scale)
        panel.set_title(title, fontsize=10, pad=2)
    figure.colorbar(scale, ax=list(axes), shrink=0.7, label=label)
    return figure


def _draw(panel: PolarAxes, values: Floats, scale: ScalarMappable) -> None:
    panel.set_axis_off()
    panel.set_ylim(0.0, RINGS[0][1])
    for inner, outer, segments in RINGS:
        turn = 2.0 * np.pi / len(segments)
        offset = 0.0 if len(segments) == len(APICAL) else 0.5
        for place, segment in enumerate(segments):
            middle = SEPTUM - turn * (place + offset)
            _fill(panel, (middle, turn), (inner, outer), int(segment), values, scale)
    _fill(panel, (0.0, 2.0 * np.pi), (0.0, RINGS[-1][0]), APEX, values, scale)


def _fill(
    panel: PolarAxes,
    angles: tuple[float, float],
    radii: tuple[float, float],
    segment: int,
    values: Floats,
    scale: ScalarMappable,
) -> None:
    """Draw one segment about an angle, of a width [rad], between two radii, with its number."""
    (middle, width), (inner, outer) = angles, radii
    value = values[segment - 1]
    line = 0.0 if segment == APEX else 0.8
    panel.bar(
        middle, outer - inner, width, inner, color=scale.to_rgba(value), edgecolor="0.4", linewidth=line
    )
    colour = "white" if value > DARK else "0.2"
    place = 0.0 if segment == APEX else 0.5 * (inner + outer)
    panel.text(middle, place, str(segment), ha="center", va="center", fontsize=7, color=colour)
