"""A recording of the left ventricle's pressure as CSV: times and pressures, each with its unit or refused.

time_s,lv_pressure_mmhg,ecg
0.000,7.9,0.02
0.001,8.0,0.03
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from heartfit.configuration.source import RecordedPressure
from heartfit.errors import InputError
from heartfit.io.cells import PASCAL, number_in, read_cells
from heartfit.observation.recorded_pressure import AveragedPressure, PressureTrace, average_beats

SECOND = {"s": 1.0, "ms": 1e-3}
UNIT = re.compile(r"(?:^|[^A-Za-z])(mmHg|kPa|ms|s)[^A-Za-z]*$", re.IGNORECASE)


def read_pressure(given: RecordedPressure, period: float) -> AveragedPressure:
    """The mean beat of the recording over the images' `period`, s.

    Raises InputError, in one line that names the file, for what cannot be read, has no unit or is no pressure.
    """
    path = Path(given.file)
    try:
        return average_beats(_trace(path, given), period, given.upstroke, given.delay)
    except InputError as fault:
        said = str(fault)
        raise InputError(said if said.startswith(str(path)) else f"{path}: {said}") from None


def _trace(path: Path, given: RecordedPressure) -> PressureTrace:
    cells = read_cells(path)
    time = _time_column(path, list(cells))
    if given.trigger is not None and given.trigger not in cells:
        raise InputError(f"{path}: no column {given.trigger}, said to be the trigger; {_known(cells)}")
    column = _pressure_column(path, given, [name for name in cells if name not in (time, given.trigger)])
    factor = PASCAL[_pressure_unit(path, column, given.unit)]
    pressures = (_numbers(path, cells, column) - given.zero) * factor
    trigger = None if given.trigger is None else _numbers(path, cells, given.trigger)
    return PressureTrace(_numbers(path, cells, time) * SECOND[_unit(time)], pressures, trigger)


def _time_column(path: Path, columns: list[str]) -> str:
    found = [name for name in columns if name.lower().startswith("time") and _unit(name) in SECOND]
    if len(found) != 1:
        raise InputError(
            f"{path}: {len(found)} columns of times with a unit among {', '.join(columns)}; expected one, such as "
            "time_s or time_ms: name it"
        )
    return found[0]


def _pressure_column(path: Path, given: RecordedPressure, columns: list[str]) -> str:
    if given.column is not None:
        if given.column not in columns:
            raise InputError(f"{path}: no column {given.column} of pressures; {_known(columns)}")
        return given.column
    named = [name for name in columns if name.lower().startswith("lv_pressure")] or columns
    if len(named) != 1:
        raise InputError(
            f"{path}: which of {', '.join(named) or 'no columns'} is the pressure of the left ventricle? "
            "Say it as column"
        )
    return named[0]


def _pressure_unit(path: Path, column: str, stated: str | None) -> str:
    own = _unit(column) if _unit(column) in PASCAL else None
    said = None if stated is None else stated.lower()
    if own is None and said is None:
        raise InputError(
            f"{path}: column {column} has no unit; expected {column}_mmhg or {column}_kpa, or unit: mmHg or kPa "
            "stated beside it"
        )
    if own is not None and said is not None and own != said:
        raise InputError(f"{path}: column {column} says one unit and {stated} is stated; correct one of them")
    return own or said or ""


def _unit(column: str) -> str:
    found = UNIT.search(column)
    return found[1].lower() if found else ""


def _numbers(path: Path, cells: Mapping[str, Sequence[str]], column: str) -> np.ndarray:
    return np.array([number_in(path, column, row, text) for row, text in enumerate(cells[column])])


def _known(columns: Iterable[str]) -> str:
    return f"known are {', '.join(columns)}: correct the name"
