"""The configuration of a study and its table of cases.

A configuration is YAML of tables, lists, text and numbers alone. Tags, which construct objects, and aliases, which can
expand until the memory is full, are refused before anything is constructed.
"""

import json
import re
from collections.abc import Hashable, Iterable, Mapping, Sequence
from functools import reduce
from pathlib import Path
from typing import Any

import yaml

from heartfit.core.errors import InputError, require_none
from heartfit.core.validation import validate
from heartfit.io.text import PASCAL, number, read_cells, read_text
from heartfit.study.case import Case
from heartfit.study.study import Study

EXPECTED = "a configuration in YAML"
DEEPEST = 20
"""Largest depth of nested tables and lists; a study has four."""

AMBIGUOUS = re.compile(r".*[_:].*|[-+]?0[0-9bx].*")
"""Notations that YAML reads as another number than a person does: 010 as 8, 1:30 as 90, 1_0 as 10."""


class PlainLoader(yaml.SafeLoader):  # type: ignore[misc]
    """YAML loader of plain tables with unique keys."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        """Construct a table; raises YAMLError for a key that occurs twice."""
        keys = [key.value for key, _ in node.value]
        for index, key in enumerate(keys):
            if isinstance(key, str) and key in keys[:index]:
                raise yaml.YAMLError(f"key {key} occurs twice in one table, line {node.start_mark.line + 1}")
        return super().construct_mapping(node, deep)

    def construct_number(self, node: yaml.ScalarNode) -> float:
        """Construct a number; raises YAMLError for an ambiguous notation."""
        number: float = yaml.SafeLoader.yaml_constructors[node.tag](self, node)
        if AMBIGUOUS.fullmatch(node.value):
            raise yaml.YAMLError(
                f"{node.value}, line {node.start_mark.line + 1}, is read as {number}: write plain digits"
            )
        return number


PlainLoader.add_constructor("tag:yaml.org,2002:int", PlainLoader.construct_number)
PlainLoader.add_constructor("tag:yaml.org,2002:float", PlainLoader.construct_number)


def read_yaml(path: Path) -> Any:
    """Read a YAML file, None if it is empty.

    Raises InputError for a file that is not text, not YAML, nested too deeply, or more than plain tables.
    """
    text = read_text(path, EXPECTED)
    try:
        _require_plain(yaml.parse(text, yaml.SafeLoader))
        return PlainLoader(text).get_single_data()
    except (yaml.YAMLError, ValueError) as fault:  # ValueError: an impossible date, a number of 5000 digits
        raise InputError(f"{path}: not YAML: {' '.join(str(fault).split())}; correct it") from None


def _require_plain(events: Iterable[yaml.Event]) -> None:
    depth = 0
    for event in events:
        line = event.start_mark.line + 1
        if isinstance(event, yaml.AliasEvent):
            raise yaml.YAMLError(
                f"an alias, *{event.anchor}, line {line}, is not read: write out its content"
            )
        if getattr(event, "tag", None) is not None:
            raise yaml.YAMLError(
                f"a tag, {event.tag}, line {line}, is not read: write plain text or a number"
            )
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
        if depth > DEEPEST:
            raise yaml.YAMLError(f"nested more than {DEEPEST} times, line {line}")


def read_study(paths: Sequence[Path]) -> Study:
    """Read and validate a study without its table of cases; raises InputError."""
    return validate(Study, read_configuration(paths), " + ".join(map(str, paths)))


def read_configuration(paths: Iterable[Path]) -> dict[str, Any]:
    """Merge the tables of several files, later ones over earlier ones, as Snakemake's --configfile does."""
    return reduce(_layered, map(_read_table, paths), {})


def schema() -> str:
    """JSON schema of a study, for editors."""
    return json.dumps(Study.model_json_schema(), indent=1) + "\n"


def _read_table(path: Path) -> dict[str, Any]:
    content = read_yaml(path) or {}
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
    """Read a table of cases; raises InputError with a line for each mistake in it."""
    cases, problems = read_rows(path)
    require_none(problems)
    return cases


def read_rows(path: Path) -> tuple[list[Case], list[str]]:
    """Read the valid rows and a line for each mistake in the others; raises InputError unless it is a table."""
    cells = read_cells(path, "\t", "a table of cases, separated by tabs")
    require_none(problem for column in cells if (problem := _unit_problem(path, column)))
    rows = [dict(zip(cells, row, strict=True)) for row in zip(*cells.values(), strict=True)]
    cases: list[Case] = []
    problems: list[str] = []
    for line, row in enumerate(rows, start=2):
        try:
            cases.append(validate(Case, _in_si(row), f"{path}, line {line}"))
        except InputError as error:
            problems += error.problems
    names = [row.get("case") for row in rows]
    duplicates = sorted({name for name in names if name and names.count(name) > 1})
    problems += [f"{path}: {name} stands in two rows; rename one" for name in duplicates]
    return cases, problems or ([] if rows else [f"{path}: no case; add a row"])


def _unit_problem(path: Path, column: str) -> str:
    for name, units in UNITS.items():
        if column not in COLUMNS and (column == name or column.startswith(f"{name}_")):
            expected = " or ".join(f"{name}_{unit}" for unit in units)
            return f"{path}: column {column} has no known unit; expected {expected}: rename it"
    return ""


def _in_si(row: dict[str, str]) -> dict[str, Any]:
    """Cells that are not empty by name, in SI where the column has a unit; text that is not a number stays."""
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
        return text  # the validation of the row rejects it
