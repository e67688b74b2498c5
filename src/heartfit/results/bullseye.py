"""The bull's-eye of the seventeen AHA segments, base outside and apex at the centre."""

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.projections.polar import PolarAxes

from heartfit.core.arrays import Floats
from heartfit.geometry.territory import APEX, APICAL, BASAL

RINGS = ((3.0, 4.0, BASAL), (2.0, 3.0, BASAL + 6), (1.0, 2.0, APICAL))
"""Inner and outer radius of each ring, and its segments in turn from the middle of the septum towards anterior."""
SEPTUM = np.pi
"""Direction of the middle of the septum in the figure, at the left as in a short-axis image; anterior is above."""


def plot_bullseye(panels: Sequence[tuple[str, Floats]], label: str, largest: float = 1.0) -> Figure:
    """Draw one bull's-eye for each titled array (17,), all with one scale from 0 to ``largest``."""
    figure = Figure(figsize=(3.2 * len(panels) + 0.9, 3.4), layout="constrained")
    axes = figure.subplots(1, len(panels), subplot_kw={"projection": "polar"}, squeeze=False)[0]
    for panel, (title, values) in zip(axes, panels, strict=True):
        drawn = _draw(panel, values, largest)
        panel.set_title(title, fontsize=10)
    figure.colorbar(drawn, ax=list(axes), shrink=0.7, label=label)
    return figure


def _draw(panel: PolarAxes, values: Floats, largest: float):  # type: ignore[no-untyped-def]
    panel.set_axis_off()
    for inner, outer, segments in RINGS:
        count = len(segments)
        offset = 0.0 if count == len(APICAL) else 0.5
        edges = SEPTUM - 2.0 * np.pi * (np.arange(count + 1) + offset - 0.5) / count
        drawn = panel.pcolormesh(
            edges,
            [inner, outer],
            values[segments - 1][None],
            cmap="Reds",
            vmin=0.0,
            vmax=largest,
            edgecolors="0.4",
        )
        for segment, angle in zip(segments, 0.5 * (edges[1:] + edges[:-1]), strict=True):
            _number(panel, angle, 0.5 * (inner + outer), int(segment), values, largest)
    turn = np.linspace(0.0, 2.0 * np.pi, 65)
    panel.pcolormesh(
        turn, [0.0, 1.0], np.full((1, 64), values[APEX - 1]), cmap="Reds", vmin=0.0, vmax=largest
    )
    _number(panel, 0.0, 0.0, APEX, values, largest)
    return drawn


def _number(
    panel: PolarAxes, angle: float, radius: float, segment: int, values: Floats, largest: float
) -> None:
    colour = "white" if values[segment - 1] > 0.6 * largest else "0.2"
    panel.text(angle, radius, str(segment), ha="center", va="center", fontsize=7, color=colour)
