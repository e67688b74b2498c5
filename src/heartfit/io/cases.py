"""Reads the table of cases, whose columns say their unit: period_s, edv_ml, edp_mmhg."""

from pathlib import Path
from typing import Any

from heartfit.configuration.case import Case
from heartfit.configuration.strict import validated
from heartfit.errors import InputError, require_none
from heartfit.io.cells import PASCAL, number, read_cells

TIMES, VOLUMES, LENGTHS = {"s": 1.0, "ms": 1e-3}, {"ml": 1e-6}, {"mm": 1e-3}
UNITS = {
    **dict.fromkeys(("period", "qrs"), TIMES),
    **dict.fromkeys(("edv", "rv_edv"), VOLUMES),
    **dict.fromkeys(("wall_thickness", "rv_wall_thickness"), LENGTHS),
    "edp": PASCAL,
}
COLUMNS = {
    f"{name}_{unit}": (name, factor) for name, units in UNITS.items() for unit, factor in units.items()
}


def read_cases(path: Path) -> list[Case]:
    """The rows of a table of cases; raises InputErrors, a line for each mistake in it."""
    cases, problems = read_rows(path)
    require_none(problems)
    return cases


def read_rows(path: Path) -> tuple[list[Case], list[str]]:
    """The rows that are in order, and a line for each mistake in the others; raises InputError for what is no table."""
    cells = read_cells(path, "\t", "a table of cases, separated by tabs")
    require_none(problem for column in cells if (problem := _unit_problem(path, column)))
    rows = [dict(zip(cells, row, strict=True)) for row in zip(*cells.values(), strict=True)]
    cases: list[Case] = []
    problems: list[str] = []
    for line, row in enumerate(rows, start=2):
        try:
            cases.append(validated(Case, _in_si(row), f"{path}, line {line}"))
        except InputError as error:
            problems += error.problems
    names = [row.get("case") for row in rows]
    twice = sorted({name for name in names if name and names.count(name) > 1})
    problems += [f"{path}: {name} stands in two rows; rename one" for name in twice]
    return cases, problems or ([] if rows else [f"{path}: no case; add a row"])


def _unit_problem(path: Path, column: str) -> str:
    for name, units in UNITS.items():
        if column not in COLUMNS and (column == name or column.startswith(f"{name}_")):
            known = " or ".join(f"{name}_{unit}" for unit in units)
            return f"{path}: column {column} says no unit that is known; expected {known}: rename it"
    return ""


def _in_si(row: dict[str, str]) -> dict[str, Any]:
    """The cells that are not empty by name, numbers in SI where the column has a unit, text that is none as it is."""
    content: dict[str, Any] = {}
    for column, text in row.items():
        name, factor = COLUMNS.get(column, (column, None))
        if text.strip():
            content[name] = text.strip() if factor is None else _scaled(text, factor)
    return content


def _scaled(text: str, factor: float) -> float | str:
    try:
        return factor * number(text)
    except ValueError:
        return text  # which is refused with the rest of the row
