"""Recordings of the left-ventricular pressure as CSV. Columns without a unit are refused, none is guessed.

time_s,lv_pressure_mmhg,ecg
0.000,7.9,0.02
0.001,8.0,0.03
"""

import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

import numpy as np

from heartfit.core.errors import InputError
from heartfit.io.text import PASCAL, number_in, read_cells
from heartfit.observation.recorded_pressure import AveragedPressure, PressureTrace, average_beats
from heartfit.study.case import RecordedPressure

SECOND = {"s": 1.0, "ms": 1e-3}
UNIT = re.compile(r"(?:^|[^A-Za-z])(mmHg|kPa|ms|s)[^A-Za-z]*$", re.IGNORECASE)


def read_pressure(source: RecordedPressure, period: float) -> AveragedPressure:
    """Average the beats of a recording over the period [s] of the images.

    Raises InputError, in one line that names the file, for a recording that cannot be read, has no unit or is not a
    pressure.
    """
    path = Path(source.file)
    try:
        return average_beats(_trace(path, source), period, source.upstroke, source.delay)
    except InputError as fault:
        message = str(fault)
        raise InputError(message if message.startswith(str(path)) else f"{path}: {message}") from None


def _trace(path: Path, source: RecordedPressure) -> PressureTrace:
    cells = read_cells(path)
    time = _time_column(path, list(cells))
    if source.trigger is not None and source.trigger not in cells:
        raise InputError(f"{path}: no column {source.trigger}, stated as the trigger; {_known(cells)}")
    column = _pressure_column(path, source, [name for name in cells if name not in (time, source.trigger)])
    factor = PASCAL[_pressure_unit(path, column, source.unit)]
    pressures = (_numbers(path, cells, column) - source.zero) * factor
    trigger = None if source.trigger is None else _numbers(path, cells, source.trigger)
    return PressureTrace(_numbers(path, cells, time) * SECOND[_unit(time)], pressures, trigger)


def _time_column(path: Path, columns: list[str]) -> str:
    named = [name for name in columns if name.lower().startswith("time") and _unit(name) in SECOND]
    if len(named) != 1:
        raise InputError(
            f"{path}: {len(named)} columns of times with a unit among {', '.join(columns)}; expected one, such as "
            "time_s or time_ms: name it"
        )
    return named[0]


def _pressure_column(path: Path, source: RecordedPressure, columns: list[str]) -> str:
    if source.column is not None:
        if source.column not in columns:
            raise InputError(f"{path}: no column {source.column} of pressures; {_known(columns)}")
        return source.column
    named = [name for name in columns if name.lower().startswith("lv_pressure")] or columns
    if len(named) != 1:
        raise InputError(
            f"{path}: the column of the left-ventricular pressure is not clear; expected one of "
            f"{', '.join(named) or 'no columns'}: state it under column"
        )
    return named[0]


def _pressure_unit(path: Path, column: str, stated: str | None) -> str:
    own = _unit(column) if _unit(column) in PASCAL else None
    declared = None if stated is None else stated.lower()
    if own is None and declared is None:
        raise InputError(
            f"{path}: column {column} has no unit; expected {column}_mmhg or {column}_kpa, or unit: mmHg or kPa "
            "stated beside it"
        )
    if own is not None and declared is not None and own != declared:
        raise InputError(
            f"{path}: column {column} and the stated unit {stated} disagree; correct one of them"
        )
    return own or declared or ""


def _unit(column: str) -> str:
    match = UNIT.search(column)
    return match[1].lower() if match else ""


def _numbers(path: Path, cells: Mapping[str, Sequence[str]], column: str) -> np.ndarray:
    return np.array([number_in(path, column, row, text) for row, text in enumerate(cells[column])])


def _known(columns: Iterable[str]) -> str:
    return f"known are {', '.join(columns)}: correct the name"
