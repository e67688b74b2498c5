"""Panels of equal size, as wide as the page."""

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure

WIDTH, LEGEND = 11.0, 0.5
"""Inches: of the page, and of the line above the panels."""


def grid(count: int, columns: int, height: float) -> tuple[Figure, list[Axes]]:
    """A figure and so many panels with one y axis, at most ``columns`` in a row, of this height in inches."""
    across = min(count, columns)
    rows = -(-count // across)
    figure = Figure(figsize=(WIDTH, LEGEND + height * rows), layout="constrained")
    panels = figure.subplots(rows, across, squeeze=False, sharey=True).ravel().tolist()
    for axes in panels[count:]:
        axes.set_axis_off()
    return figure, panels[:count]


def legend(figure: Figure, panels: Sequence[Axes]) -> None:
    """Above the panels, each label once."""
    named = {
        label: each for axes in panels for each, label in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    figure.legend(
        list(named.values()), list(named), loc="outside upper center", ncols=len(named), frameon=False
    )
