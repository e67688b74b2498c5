"""Reads the configuration of a study, and writes its schema."""

import json
from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from pathlib import Path
from typing import Any

from heartfit.configuration.strict import validated
from heartfit.configuration.study import Study
from heartfit.errors import InputError
from heartfit.io.plain_yaml import read_yaml


def read_study(paths: Sequence[Path]) -> Study:
    """The study that the files describe, whatever its cases; raises InputError."""
    return validated(Study, read_configuration(paths), " + ".join(map(str, paths)))


def read_configuration(paths: Iterable[Path]) -> dict[str, Any]:
    """What the files say together, later ones over earlier ones, as Snakemake's --configfile does."""
    return reduce(_layered, map(_read_table, paths), {})


def schema() -> str:
    """The JSON schema of a study, for editors."""
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
