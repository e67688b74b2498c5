"""Septal flash of true, registered and calibrated walls, as table and figure."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from heartfit.observation.strain import WallMotion, early_stretch, septal_flash, shortening_delay
from heartfit.results.figures import clean
from heartfit.results.shape import WALL_COLUMNS

TRUE, REGISTERED = "true", "registered"
"""Names of the measured motions; calibrated motions have the name of their setting."""

WallsByCase = Mapping[str, Mapping[str, WallMotion]]


def walls_by_case(
    cases: Sequence[str],
    settings: Sequence[str],
    true: Iterable[WallMotion],
    registered: Iterable[WallMotion],
    calibrated: Iterable[pd.DataFrame],
) -> WallsByCase:
    """Return the walls of each case by motion: true, registered, and by setting; a failed beat is omitted.

    calibrated: shapes with walls, all settings of the first case, then of the next.
    """
    shapes = iter(calibrated)
    return {
        case: {TRUE: first, REGISTERED: second} | dict(_calibrated_walls(settings, shapes))
        for case, first, second in zip(cases, true, registered, strict=True)
    }


def flash_table(walls: WallsByCase) -> pd.DataFrame:
    """Return one row per case and motion; cells without a septal flash are empty."""
    return pd.DataFrame(
        [
            {"case": case, "motion": motion} | _flash_row(wall_motion)
            for case, motions in walls.items()
            for motion, wall_motion in motions.items()
        ]
    )


def _calibrated_walls(
    settings: Sequence[str], shapes: Iterator[pd.DataFrame]
) -> Iterator[tuple[str, WallMotion]]:
    for setting, shape in zip(settings, shapes, strict=False):
        if len(shape):
            curves = {name: unit * shape[column].to_numpy() for column, (name, unit) in WALL_COLUMNS.items()}
            cavity = 1e-6 * shape["LV volume (mL)"].to_numpy()
            yield setting, WallMotion(times=shape["time (s)"].to_numpy(), cavity=cavity, **curves)


def _flash_row(walls: WallMotion) -> dict[str, float | None]:
    flash = septal_flash(walls)
    return {
        "septal flash (mm)": 1e3 * flash.size if flash else None,
        "from (ms)": 1e3 * flash.start if flash else None,
        "to (ms)": 1e3 * flash.end if flash else None,
        "rebound (mm)": 1e3 * flash.rebound if flash else None,
        "lateral stretch (%)": 1e2 * early_stretch(walls),
        "septal to lateral peak (ms)": 1e3 * shortening_delay(walls),
    }


COLOURS = {"septum": "#D55E00", "lateral wall": "#0072B2"}
ROWS = {
    "towards the opposite wall (mm)": ("septum inward (mm)", "lateral wall inward (mm)"),
    "circumferential strain (%)": ("septal strain (%)", "lateral strain (%)"),
}
STYLES: dict[str, dict[str, Any]] = {
    TRUE: {"linewidth": 1.8},
    REGISTERED: {"linestyle": "none", "marker": "o", "markersize": 3.5},
}
CALIBRATED_LINES: tuple[dict[str, Any], ...] = ({"linestyle": "--"}, {"linestyle": ":"}, {"linestyle": "-."})
SHOWN_TIMES = (-0.1, 0.65)
"""Range of the time after the trigger [s]."""


def plot_walls(walls: WallsByCase, settings: Sequence[str]) -> Figure:
    """Plot motions (top) and strains (bottom) of both walls, one column per case; the true septal flash is shaded.

    settings: of all calibrated motions; the line of a setting follows from its place among them.
    """
    styles = STYLES | {
        setting: CALIBRATED_LINES[index % len(CALIBRATED_LINES)] for index, setting in enumerate(settings)
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


def _draw(
    axes: Axes,
    motions: Mapping[str, WallMotion],
    columns: Sequence[str],
    styles: Mapping[str, dict[str, Any]],
) -> None:
    for motion, walls in motions.items():
        shown = walls.starting_before_trigger()
        for column, colour in zip(columns, COLOURS.values(), strict=True):
            name, unit = WALL_COLUMNS[column]
            axes.plot(shown.times, getattr(shown, name) / unit, color=colour, **styles[motion])
    axes.axhline(0, color="black", linewidth=0.6)
    axes.set_xlim(*SHOWN_TIMES)
    clean(axes)


def _mark(column: Sequence[Axes], walls: WallMotion) -> None:
    """Shade the septal flash and print its size."""
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
