"""The 17 segments of the left ventricle in one plane: apex in the middle, anterior on top, septum on the left.

References
----------
Cerqueira MD et al. 2002, doi 10.1161/hc0402.102975.
"""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Wedge

from heartfit.geometry.arrays import Floats

RINGS = (  # first segment, how many, where the first one starts in degrees, inner and outer radius
    (1, 6, 60.0, 0.75, 1.0),
    (7, 6, 60.0, 0.5, 0.75),
    (13, 4, 45.0, 0.25, 0.5),
    (17, 1, 0.0, 0.0, 0.25),
)
WALLS = {"anterior": (0, 1.1, 0), "inferior": (0, -1.1, 0), "septal": (-1.1, 0, 90), "lateral": (1.1, 0, -90)}
"""Where the name of each wall stands, and how it is turned, in degrees."""


def draw_bullseye(axes: Axes, values: Mapping[int, tuple[float, Floats]]) -> None:
    """Draw the AHA segments, each with its value, rounded, on its colour; those without value are left out."""
    for first, count, start, inner, outer in RINGS:
        width = 360.0 / count
        for segment in set(range(first, first + count)) & set(values):
            begin = start + (segment - first) * width
            _draw(axes, (begin, begin + width), (inner, outer), *values[segment])
    for name, (x, y, turn) in WALLS.items():
        axes.text(x, y, name, ha="center", va="center", fontsize=8, rotation=turn)
    axes.set(xlim=(-1.2, 1.2), ylim=(-1.2, 1.2), aspect="equal")
    axes.set_axis_off()


def _draw(
    axes: Axes, angles: tuple[float, float], radii: tuple[float, float], value: float, colour: Floats
) -> None:
    inner, outer = radii
    axes.add_patch(Wedge((0, 0), outer, *angles, width=outer - inner, facecolor=colour, edgecolor="white"))
    angle, radius = np.deg2rad(np.mean(angles)), 0.5 * (inner + outer) if inner else 0.0
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    axes.text(x, y, f"{value:.0f}", ha="center", va="center", fontsize=8)
