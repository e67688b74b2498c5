"""Reads the table of cases."""

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from heartfit.configuration.case import Case
from heartfit.configuration.strict import validated
from heartfit.errors import InputError, require_none

UNITS = {"_ms": 1e-3, "_s": 1.0, "_ml": 1e-6, "_mm": 1e-3}


def read_cases(path: Path) -> list[Case]:
    """The rows of a table of cases, whose columns say their unit: period_s, edv_ml, wall_thickness_mm.

    Raises InputErrors, a line for each mistake in it.
    """
    cases, problems = read_rows(path)
    require_none(problems)
    return cases


def read_rows(path: Path) -> tuple[list[Case], list[str]]:
    """The rows that are in order, and a line for each mistake in the others; raises InputError for a missing file."""
    if not path.is_file():
        raise InputError(
            f"{path}: no such file; expected a table of cases: correct `cases` in the configuration"
        )
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
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


def _in_si(row: Mapping[str, str | None]) -> dict[str, Any]:
    """Column names without their unit, numbers in SI, text that is no number as it is, empty cells left out."""
    content: dict[str, Any] = {}
    for column, text in row.items():
        unit = next((unit for unit in UNITS if column.endswith(unit)), "")
        if text:
            content[column.removesuffix(unit)] = _in_metres_and_seconds(text, unit) if unit else text
    return content


def _in_metres_and_seconds(text: str, unit: str) -> float | str:
    try:
        return float(text) * UNITS[unit]
    except ValueError:
        return text  # which is refused with the rest of the row
