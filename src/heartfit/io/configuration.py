"""Reads the configuration of a study and its table of cases, and writes the schema of the former."""

import csv
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from pathlib import Path
from typing import Any

import yaml

from heartfit.configuration.case import Case
from heartfit.configuration.strict import validated
from heartfit.configuration.study import Study
from heartfit.errors import InputError
from heartfit.io.measured_heart import read_measured_heart, short_axis_images

LARGEST_PERIOD_DIFFERENCE = 0.02
UNITS = {"_ms": 1e-3, "_s": 1.0, "_ml": 1e-6, "_mm": 1e-3}


@dataclass(frozen=True)
class Plan:
    """A study with the cases that can be run, by name, and in one line what is left out, if anything.

    measured_heart: the folder of the measured heart; images: its short-axis cine; None where there is none.
    """

    study: Study
    cases: Mapping[str, Case]
    measured_heart: Path | None
    images: Path | None
    left_out: str


def plan_study(content: Mapping[str, Any], where: str = "configuration") -> Plan:
    """What can be run of the study that `content` describes; raises InputError before anything is."""
    study = validated(Study, content, where)
    folder = next((Path(each) for each in study.measured_heart if Path(each).is_dir()), None)
    cases = {case.case: case for case in read_cases(Path(study.cases))}
    absent = [name for name, case in cases.items() if case.kind == "measured" and folder is None]
    kept = {name: case for name, case in cases.items() if name not in absent}
    measured = [case for case in kept.values() if case.kind == "measured"]
    if folder is not None and measured:
        _require_sound(folder, measured)
    _require_reference(study, kept)
    left_out, images = _left_out(absent, study) if absent else "", None
    if folder is not None and measured:
        images = short_axis_images(folder)
        if images is None:
            left_out = f"registration of images left out: no short-axis cine {folder / 'cine' / 'sax*'}"
    return Plan(study, kept, folder, images, left_out)


def _require_sound(folder: Path, cases: Sequence[Case]) -> None:
    """Read the measured heart as its jobs will, so that what is wrong with it is said before anything runs."""
    heart = read_measured_heart(folder)
    for case in cases:
        if abs(case.period / heart.period - 1.0) > LARGEST_PERIOD_DIFFERENCE:
            raise InputError(
                f"{case.case}: period_s is {case.period:g}, the beat lengths in {folder} say {heart.period:.3f} s; "
                "expected the same to 2 %: correct the table of cases"
            )


def _require_reference(study: Study, cases: Mapping[str, Case]) -> None:
    if study.sensitivity.case not in cases:
        raise InputError(
            f"sensitivity.case = {study.sensitivity.case!r} is no case that can be run; known are {', '.join(cases)}"
        )


def _left_out(absent: Sequence[str], study: Study) -> str:
    return (
        f"{', '.join(absent)} left out: no measured heart in {' or '.join(study.measured_heart)}; "
        "`snakemake --cores 1 fetch_measured_heart` brings it"
    )


def read_study(paths: Sequence[Path]) -> Study:
    """The study that the files describe, whatever its cases; raises InputError."""
    return validated(Study, read_configuration(paths), " + ".join(map(str, paths)))


def read_configuration(paths: Sequence[Path]) -> dict[str, Any]:
    """What the files say together, later ones over earlier ones, as Snakemake's --configfile does."""
    return reduce(_layered, map(_read_yaml, paths), {})


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
