"""The septum against the lateral wall: curves as columns, and what is read from them."""

from collections.abc import Iterable, Iterator, Mapping, Sequence

import pandas as pd

from heartfit.observation.walls import Walls, delay_of_shortening, early_stretch, septal_flash

WALL_COLUMNS = {  # column of a curve: what one printed unit is in SI
    "septum inward (mm)": ("septal", 1e-3),
    "lateral wall inward (mm)": ("lateral", 1e-3),
    "septal strain (%)": ("septal_strain", 0.01),
    "lateral strain (%)": ("lateral_strain", 0.01),
}
TRUE, REGISTERED = "true", "registered"
"""The motions that are measured, beside those that are calibrated, which go by their setting."""

WallsByCase = Mapping[str, Mapping[str, Walls]]


def walls_table(walls: Walls) -> pd.DataFrame:
    """One row per phase, in time: the curves of the walls."""
    return pd.DataFrame(
        {column: getattr(walls, name) / unit for column, (name, unit) in WALL_COLUMNS.items()}
    )


def walls_by_case(
    cases: Sequence[str],
    settings: Sequence[str],
    true: Iterable[Walls],
    registered: Iterable[Walls],
    calibrated: Iterable[pd.DataFrame],
) -> WallsByCase:
    """The walls of each case by motion: true, registered, and by setting; a beat that failed is left out.

    calibrated: shapes with walls (heartfit.tables.shape_table), of all settings of the first case, then of the next.
    """
    shapes = iter(calibrated)
    return {
        case: {TRUE: first, REGISTERED: second} | dict(_completed(settings, shapes))
        for case, first, second in zip(cases, true, registered, strict=True)
    }


def flash_table(walls: WallsByCase) -> pd.DataFrame:
    """One row per case and motion; nothing under a septal flash that did not happen."""
    return pd.DataFrame(
        [
            {"case": case, "motion": motion} | _read(each)
            for case, motions in walls.items()
            for motion, each in motions.items()
        ]
    )


def _completed(settings: Sequence[str], shapes: Iterator[pd.DataFrame]) -> Iterator[tuple[str, Walls]]:
    for setting, shape in zip(settings, shapes, strict=False):
        if len(shape):
            curves = {name: unit * shape[column].to_numpy() for column, (name, unit) in WALL_COLUMNS.items()}
            cavity = 1e-6 * shape["LV volume (mL)"].to_numpy()
            yield setting, Walls(times=shape["time (s)"].to_numpy(), cavity=cavity, **curves)


def _read(walls: Walls) -> dict[str, float | None]:
    flash = septal_flash(walls)
    return {
        "septal flash (mm)": 1e3 * flash.size if flash else None,
        "from (ms)": 1e3 * flash.start if flash else None,
        "to (ms)": 1e3 * flash.end if flash else None,
        "rebound (mm)": 1e3 * flash.rebound if flash else None,
        "lateral stretch (%)": 1e2 * early_stretch(walls),
        "septal to lateral peak (ms)": 1e3 * delay_of_shortening(walls),
    }
