"""The septal flash: how the septum and the lateral wall move and shorten, in patients beside a volunteer."""

from collections.abc import Mapping, Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from heartfit.observation.walls import Walls, septal_flash
from heartfit.tables.figures import clean
from heartfit.tables.walls_table import REGISTERED, TRUE, WALL_COLUMNS, WallsByCase

COLOURS = {"septum": "#D55E00", "lateral wall": "#0072B2"}
ROWS = {
    "towards the opposite wall (mm)": ("septum inward (mm)", "lateral wall inward (mm)"),
    "circumferential strain (%)": ("septal strain (%)", "lateral strain (%)"),
}
STYLES: dict[str, dict[str, Any]] = {
    TRUE: {"linewidth": 1.8},
    REGISTERED: {"linestyle": "none", "marker": "o", "markersize": 3.5},
}
CALIBRATED: tuple[dict[str, Any], ...] = ({"linestyle": "--"}, {"linestyle": ":"}, {"linestyle": "-."})
SHOWN = (-0.1, 0.65)
"""Time after the trigger, s."""


def plot_walls(walls: WallsByCase) -> Figure:
    """One column per case: motions of both walls above, their strains below; the true septal flash is shaded."""
    styles = STYLES | {
        setting: CALIBRATED[index % len(CALIBRATED)] for index, setting in enumerate(_settings(walls))
    }
    figure = Figure(figsize=(2.0 + 3.6 * len(walls), 6.2), layout="constrained")
    panels = figure.subplots(len(ROWS), len(walls), sharex=True, sharey="row", squeeze=False)
    for column, (case, motions) in zip(panels.T, walls.items(), strict=True):
        column[0].set_title(case, fontsize=10)
        for axes, row in zip(column, ROWS.values(), strict=True):
            _draw(axes, motions, row, styles)
        _mark(column, motions[TRUE])
        column[-1].set_xlabel("time after trigger (s)")
    for axes, label in zip(panels[:, 0], ROWS, strict=True):
        axes.set_ylabel(label)
    _key(figure, styles)
    return figure


def _settings(walls: WallsByCase) -> list[str]:
    names = [motion for motions in walls.values() for motion in motions if motion not in STYLES]
    return list(dict.fromkeys(names))


def _draw(
    axes: Axes, motions: Mapping[str, Walls], columns: Sequence[str], styles: Mapping[str, dict[str, Any]]
) -> None:
    for motion, walls in motions.items():
        seen = walls.from_before_the_trigger()
        for column, colour in zip(columns, COLOURS.values(), strict=True):
            name, unit = WALL_COLUMNS[column]
            axes.plot(seen.times, getattr(seen, name) / unit, color=colour, **styles[motion])
    axes.axhline(0, color="black", linewidth=0.6)
    axes.set_xlim(*SHOWN)
    clean(axes)


def _mark(column: Sequence[Axes], walls: Walls) -> None:
    """Shade the flash and say how far it goes."""
    flash = septal_flash(walls)
    if not flash:
        column[0].text(0.02, 0.95, "no septal flash", transform=column[0].transAxes, fontsize=9)
        return
    for axes in column:
        axes.axvspan(flash.start, flash.end, color="#F0E442", alpha=0.35, linewidth=0)
    text = f"septal flash {1e3 * flash.size:.1f} mm"
    column[0].text(0.02, 0.95, text, transform=column[0].transAxes, fontsize=9)


def _key(figure: Figure, styles: Mapping[str, dict[str, Any]]) -> None:
    lines = [Line2D([], [], color=colour, label=wall) for wall, colour in COLOURS.items()]
    for motion, style in styles.items():
        label = motion if motion in STYLES else f"calibrated, {motion} setting"
        lines.append(Line2D([], [], color="#444444", label=label, **style))
    figure.legend(handles=lines, loc="outside lower center", ncols=len(lines), frameon=False, fontsize=9)
