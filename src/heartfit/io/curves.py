"""Curves of a beat as CSV: one time column, one column per curve, the unit in the column's name.

# period_s = 0.829
time_s,lv_volume_ml,rv_volume_ml,lv_pressure_kpa,mitral_flow_ml_per_s
0.0,174.49,170.1,1.3,0.0

A curve has empty cells at times at which only other curves were sampled. Files of others may have times in ms and
pressures in mmHg, columns between semicolons or tabs, and then decimal commas; written files have none of these.
"""

import difflib
import re
from collections.abc import Mapping
from io import StringIO
from pathlib import Path

import numpy as np

from heartfit.core.errors import InputError
from heartfit.io.files import write_text
from heartfit.io.text import LARGEST, PASCAL, number, number_in, read_cells, read_text
from heartfit.observation.curve import Curve

UNITS = {"volume": ("ml", 1e-6), "pressure": ("kpa", 1e3), "flow": ("ml_per_s", 1e-6)}
PLACES = {
    "volume": ("lv", "rv"),
    "pressure": ("lv", "rv", "aorta", "pulmonary_artery", "left_atrium", "right_atrium"),
    "flow": ("aortic", "mitral", "pulmonary", "tricuspid"),
}
KINDS = {f"{place}_{kind}": kind for kind, places in PLACES.items() for place in places}
FURTHER_UNITS = {"volume": (), "pressure": (("mmhg", PASCAL["mmhg"]),), "flow": ()}
COLUMNS = {
    f"{name}_{unit}": (name, factor)
    for name, kind in KINDS.items()
    for unit, factor in (UNITS[kind], *FURTHER_UNITS[kind])
}
"""Curve and SI value of the unit by column."""
COLUMNS |= {  # the usual name
    f"aortic_pressure_{unit}": COLUMNS[f"aorta_pressure_{unit}"] for unit in ("kpa", "mmhg")
}
TIMES = {"time_s": 1.0, "time_ms": 1e-3}
"""Columns of times, and their unit [s]."""
PERIOD = re.compile(r"^#\s*period_s\s*=\s*(.*?)\s*$", re.MULTILINE)
FLOW = re.compile(r"(\w+_flow)_ml_per_s")  # any branch, since mechanisms may add one


def kind_of(name: str) -> str:
    """Kind of a curve by its name: "volume", "pressure" or "flow"."""
    return name.rsplit("_", 1)[1]


def _curve_of(column: str) -> tuple[str, float] | None:
    """Return name and SI value of the unit of a column of curves, None for any other."""
    branch = FLOW.fullmatch(column)
    return (branch[1], UNITS["flow"][1]) if branch else COLUMNS.get(column.lower())


def write_table_of_curves(
    path: Path, times: np.ndarray, values: Mapping[str, np.ndarray], period: float
) -> None:
    """Write SI arrays by name ("lv_volume", ...) over one time axis, in the units of the file."""
    table = {"time_s": times}
    for name, array in values.items():
        unit, factor = UNITS[kind_of(name)]
        table[f"{name}_{unit}"] = array / factor
    body = StringIO()
    np.savetxt(body, np.column_stack(list(table.values())), "%.12g", ",", header=",".join(table), comments="")
    write_text(path, f"# period_s = {float(period)!r}\n{body.getvalue().replace('nan', '')}")


def read_table_of_curves(
    path: Path, period: float | None = None
) -> tuple[np.ndarray, dict[str, np.ndarray], float]:
    """Read times [s], SI arrays by name, and the period [s], stated by the file unless it is an argument.

    Raises InputError for a missing file, time column or period, an unknown column, and for text, NaN or an empty cell
    instead of a number.
    """
    times, values, period = read_sampled(path, period)
    for name, array in values.items():
        if np.isnan(array).any():
            row = int(np.flatnonzero(np.isnan(array))[0]) + 1
            raise InputError(f"{path}: {name} in data row {row} is empty; expected a number in every row")
    return times, values, period


def read_sampled(path: Path, period: float | None) -> tuple[np.ndarray, dict[str, np.ndarray], float]:
    """Read as :func:`read_table_of_curves`, with NaN in empty cells."""
    numbers = {column: _numbers(path, column, cells) for column, cells in _table(path).items()}
    times = next(numbers[column] * unit for column, unit in TIMES.items() if column in numbers)
    values: dict[str, np.ndarray] = {}
    for column, array in numbers.items():
        if curve := _curve_of(column):
            name, factor = curve
            if name in values:
                raise InputError(f"{path}: {name} in two columns, one of them {column}; remove one")
            values[name] = array * factor
    return times, values, _period(path) if period is None else period


def write_curves(path: Path, curves: Mapping[str, Curve]) -> None:
    """Write curves of one period, each with its sampling times; raises ValueError if the periods differ."""
    first = next(iter(curves.values()))
    for name, curve in curves.items():
        if curve.period != first.period:
            raise ValueError(f"curves: {name} has its own period; expected one period in a file")
    times = np.unique(np.concatenate([curve.times for curve in curves.values()]))
    spread = {name: spread_over(times, curve.times, curve.values) for name, curve in curves.items()}
    write_table_of_curves(path, times, spread, first.period)


def spread_over(times: np.ndarray, sampled: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Values (k,) at the places of their ``sampled`` times (k,) among ``times`` (t,), NaN elsewhere."""
    spread = np.full(len(times), np.nan)
    spread[np.searchsorted(times, sampled)] = values
    return spread


def read_curves(path: Path, period: float | None = None) -> dict[str, Curve]:
    """Read curves by name in SI units, empty cells left out; raises InputError for samples that a curve refuses."""
    times, values, period = read_sampled(path, period)
    makers = {"volume": Curve.of_volume, "pressure": Curve.of_pressure, "flow": Curve}
    sampled = {name: ~np.isnan(array) for name, array in values.items()}
    try:
        return {
            name: makers[kind_of(name)](times[sampled[name]], array[sampled[name]], period)
            for name, array in values.items()
        }
    except InputError as error:
        raise InputError(f"{path}: {error}") from error


def _table(path: Path) -> dict[str, list[str]]:
    table = read_cells(path)
    times = [column for column in TIMES if column in table]
    if len(times) != 1:
        raise InputError(
            f"{path}: {' and '.join(times) or 'no column time_s'} among {', '.join(table)}; expected times in seconds "
            "or milliseconds: name their column time_s or time_ms"
        )
    if len(table) == 1:
        raise InputError(f"{path}: no curve other than {times[0]}; expected a column such as lv_volume_ml")
    return table


def _numbers(path: Path, column: str, cells: list[str]) -> np.ndarray:
    """Numbers of a column, NaN where a cell is empty; times may not be empty."""
    if column not in TIMES and _curve_of(column) is None:
        raise InputError(
            f"{path}: unknown column {column}; did you mean {' or '.join(_nearest(column))}? Rename it or leave it out"
        )
    values = np.full(len(cells), np.nan)
    for row, cell in enumerate(cells):
        if cell.strip() or column in TIMES:
            values[row] = number_in(path, column, row, cell)
    return values


def _nearest(column: str) -> list[str]:
    """Return the columns that are nearest to an unknown one, all that are equally near: "volume" names no ventricle.

    Those of a curve without a unit are the curve with each unit.
    """
    if units := [known for known in sorted(COLUMNS) if known.startswith(f"{column.lower()}_")]:
        return units
    likeness = {
        known: difflib.SequenceMatcher(None, known, column.lower()).ratio() for known in sorted(COLUMNS)
    }
    return [known for known in likeness if likeness[known] == max(likeness.values())]


def stated_period(path: Path) -> float | None:
    """Period [s] that a file of curves states, None without one; raises InputError for another text or two periods."""
    texts = set(PERIOD.findall(read_text(path, "curves as CSV", LARGEST)))
    try:
        periods = {number(text) for text in texts}
    except ValueError as fault:
        raise InputError(f"{path}: period_s is {fault}, such as '# period_s = 0.829': correct it") from None
    if len(periods) > 1:
        raise InputError(
            f"{path}: period_s is stated as {' and '.join(sorted(texts))}; expected one: correct it"
        )
    return periods.pop() if periods else None


def _period(path: Path) -> float:
    period = stated_period(path)
    if period is None:
        raise InputError(
            f"{path}: no period; expected a first line '# period_s = SECONDS' with the time from one R wave to the "
            "next, or the period as an argument (--rr SECONDS)"
        )
    return period
