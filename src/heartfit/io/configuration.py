"""Reads the configuration of a study and its table of cases, and writes the schema of the former."""

import csv
import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import yaml

from heartfit.configuration.case import Case
from heartfit.configuration.strict import validated
from heartfit.configuration.study import Study
from heartfit.errors import InputError

UNITS = {"_s": 1.0, "_ml": 1e-6, "_mm": 1e-3}


def read_study(*paths: Path) -> Study:
    """The study that the files say together, later ones over earlier ones."""
    content: dict[str, Any] = {}
    for path in paths:
        content = _layered(content, _read_yaml(path))
    return validated(Study, content, " + ".join(map(str, paths)))


def read_cases(path: Path) -> list[Case]:
    """The rows of a table of cases, whose columns say their unit: period_s, edv_ml, wall_thickness_mm."""
    if not path.is_file():
        raise InputError(
            f"{path}: no such file; expected a table of cases: correct `cases` in the configuration"
        )
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    cases = [
        validated(Case, _in_si(path, row), f"{path}, line {line}") for line, row in enumerate(rows, start=2)
    ]
    names = [case.case for case in cases]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice or not cases:
        problem = f"{twice[0]} stands in two rows; rename one" if twice else "no case; add a row"
        raise InputError(f"{path}: {problem}")
    return cases


def measured_heart_folder(candidates: Sequence[str]) -> Path | None:
    """The first folder that exists."""
    return next((Path(folder) for folder in candidates if Path(folder).is_dir()), None)


def schema() -> str:
    """The JSON schema of a study, for editors."""
    return json.dumps(Study.model_json_schema(), indent=1) + "\n"


def _read_yaml(path: Path) -> dict[str, Any]:
    if not path.is_file():
        raise InputError(f"{path}: no such file; expected a configuration in YAML: correct the path")
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8")) or {}
    except yaml.YAMLError as error:
        raise InputError(f"{path}: not YAML: {' '.join(str(error).split())}; correct it") from None
    if not isinstance(content, dict):
        raise InputError(
            f"{path}: holds a {type(content).__name__}; expected keys and values such as `cases: ...`"
        )
    return content


def _layered(below: Mapping[str, Any], above: Mapping[str, Any]) -> dict[str, Any]:
    merged = dict(below)
    for key, value in above.items():
        both = isinstance(value, Mapping) and isinstance(below.get(key), Mapping)
        merged[key] = _layered(below[key], value) if both else value
    return merged


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
