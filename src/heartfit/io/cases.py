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
            cases.append(validated(Case, _in_si(path, row), f"{path}, line {line}"))
        except InputError as error:
            problems += error.problems
    names = [row.get("case") for row in rows]
    twice = sorted({name for name in names if name and names.count(name) > 1})
    problems += [f"{path}: {name} stands in two rows; rename one" for name in twice]
    require_none(problems or ([] if rows else [f"{path}: no case; add a row"]))
    return cases


def _in_si(path: Path, row: Mapping[str, str | None]) -> dict[str, Any]:
    """Column names without their unit, numbers in SI, empty cells left out."""
    content: dict[str, Any] = {}
    for column, text in row.items():
        unit = next((unit for unit in UNITS if column.endswith(unit)), "")
        if text:
            content[column.removesuffix(unit)] = _number(path, column, text) * UNITS[unit] if unit else text
    return content


def _number(path: Path, column: str, text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise InputError(f"{path}: {column} = {text!r}; expected a number") from None
