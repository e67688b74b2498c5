"""Shape of a motion and septal flash, as tables and figures.

The shape over the beat, and its values at end systole beside those measured in health.

References ---------- Stoylen A et al. 2018, doi 10.1111/echo.13825: descent of the mitral ring 15.8 (sd 2.5) mm, 16.3
(2.4) % of the length of the wall, in 1266 adults. Lorenz CH et al. 2000, Delineation of normal human left ventricular
twist, J Cardiovasc Magn Reson 2: twist 12.6 (1.5) degrees in ten; Young AA, Cowan BR 2012, doi
10.1186/1532-429X-14-49: about 13.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat, nodal_motion
from heartfit.observation.shape import Shape, motion_shape
from heartfit.observation.strain import WallMotion, early_stretch, septal_flash, shortening_delay, wall_motion
from heartfit.results.figures import STYLE, clean

WALL_COLUMNS = {  # column: attribute of the curve, SI value of the printed unit
    "septum inward (mm)": ("septal", 1e-3),
    "lateral wall inward (mm)": ("lateral", 1e-3),
    "septal strain (%)": ("septal_strain", 0.01),
    "lateral strain (%)": ("lateral_strain", 0.01),
}
TRUE, REGISTERED = "true", "registered"
"""Names of the measured motions; calibrated motions have the name of their setting."""

WallsByCase = Mapping[str, Mapping[str, WallMotion]]


def walls_table(walls: WallMotion) -> pd.DataFrame:
    """Return one row per time: curves of the walls."""
    return pd.DataFrame(
        {column: getattr(walls, name) / unit for column, (name, unit) in WALL_COLUMNS.items()}
    )


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


def plot_walls(walls: WallsByCase) -> Figure:
    """Plot motions (top) and strains (bottom) of both walls, one column per case; the true septal flash is shaded."""
    styles = STYLES | {
        setting: CALIBRATED_LINES[index % len(CALIBRATED_LINES)]
        for index, setting in enumerate(_settings(walls))
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


COLUMNS = {  # column: attribute of the curve, SI value of the printed unit
    "shortening (%)": ("shortening", 0.01),
    "descent of the base (mm)": ("descent", 1e-3),
    "rise of the apex (mm)": ("rise", 1e-3),
    "free wall inward (mm)": ("inward", 1e-3),
    "thickening (%)": ("thickening", 0.01),
    "twist (degrees)": ("twist", np.deg2rad(1.0)),
    "LV volume (mL)": ("cavity", 1e-6),
}
VOLUME_COLUMNS = (
    "element volume, 1st percentile",
    "element volume, median",
    "element volume, 99th percentile",
)
HEALTHY = {
    "shortening (%)": "16.3 ± 2.4",
    "descent of the base (mm)": "15.8 ± 2.5",
    "twist (degrees)": "12.6 ± 1.5",
}


def shape_table(shape: Shape) -> pd.DataFrame:
    """Return one row per time: curves of the shape in the units of the columns."""
    table = {"time (s)": shape.times}
    table |= {column: getattr(shape, name) / unit for column, (name, unit) in COLUMNS.items()}
    return pd.DataFrame(table | dict(zip(VOLUME_COLUMNS, shape.volume.T, strict=True)))


def beat_shape_table(mesh: VentricularMesh, beat: Beat) -> pd.DataFrame:
    """Return shape and walls of a beat of the ventricles ``mesh``; no rows if the beat failed."""
    if not beat.completed:
        return pd.DataFrame(columns=["time (s)", *COLUMNS, *VOLUME_COLUMNS, *WALL_COLUMNS])
    motion = nodal_motion(beat)
    return shape_table(motion_shape(mesh, motion)).join(walls_table(wall_motion(mesh, motion)))


def end_systole_table(shapes: Mapping[str, pd.DataFrame]) -> pd.DataFrame:
    """Return one row per quantity, one column per motion, at its least left volume; empty cells for a failed beat."""
    values_by_motion = {name: _at_least_volume(shape) for name, shape in shapes.items()}
    rows = ["time (s)", *COLUMNS, *VOLUME_COLUMNS]
    table = {"at end systole": rows} | {
        name: [values.get(row) for row in rows] for name, values in values_by_motion.items()
    }
    return pd.DataFrame(table | {"healthy adults": [HEALTHY.get(row, "") for row in rows]})


def _at_least_volume(shape: pd.DataFrame) -> dict[str, float]:
    return {} if shape.empty else dict(shape.loc[shape["LV volume (mL)"].idxmin()])


def plot_shape(shapes: Mapping[str, pd.DataFrame], title: str) -> Figure:
    """Plot one panel per curve over the time after the trigger; the last has the spread of the element volumes.

    shapes: "measured" and "calibrated", from shape_table and beat_shape_table; a failed beat has no rows and no line.
    """
    figure = Figure(figsize=(13, 6), layout="constrained")
    panels = figure.subplots(2, 4).ravel()
    for name, shape in shapes.items():
        for axes, column in zip(panels, COLUMNS, strict=False):
            axes.plot(shape["time (s)"], shape[column], label=name, **STYLE[name])
        for column in (VOLUME_COLUMNS[0], VOLUME_COLUMNS[-1]):
            panels[-1].plot(shape["time (s)"], shape[column], **STYLE[name])
    for axes, heading in zip(panels, (*COLUMNS, "element volume, 1st and 99th percentile"), strict=True):
        axes.set_title(heading, fontsize=9)
        axes.set_xlabel("time after trigger (s)")
        clean(axes)
    panels[0].legend(frameon=False, fontsize=8)
    figure.suptitle(title, fontsize=11)
    return figure
