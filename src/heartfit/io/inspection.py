"""Everything that is wrong with a study at once, and what its measured hearts were understood to be."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from heartfit.configuration.source import WALLS, Source
from heartfit.configuration.strict import validated
from heartfit.configuration.study import Study
from heartfit.errors import InputError
from heartfit.io.cases import read_rows
from heartfit.io.plan import Plan, outline
from heartfit.io.sources import Subject, examine, with_cine

T = TypeVar("T")


@dataclass(frozen=True)
class Inspection:
    """The plan of a study, None unless configuration and cases are in order; the data of its measured cases as far as
    they can be read; and a line for each mistake.
    """

    plan: Plan | None
    subjects: Sequence[Subject]
    problems: Sequence[str]


def inspect(content: Mapping[str, Any], where: str) -> Inspection:
    """All that is wrong with the study that `content` describes: one mistake does not hide the others."""
    problems: list[str] = []
    _attempt(problems, validated, Study, content, where)
    table = content.get("cases")
    rows, more = (
        _attempt(problems, read_rows, Path(table)) or ([], []) if isinstance(table, str) else ([], [])
    )
    problems += more
    plan = None if problems else _attempt(problems, outline, content, where)
    cases = {case.case: case for case in rows} if plan is None else plan.cases
    sources = _sound(content.get("sources")) if plan is None else plan.sources
    subjects = [examine(cases[name], source) for name, source in sources.items() if name in cases]
    read = {subject.case.case for subject in subjects}
    problems += [problem for subject in subjects for problem in subject.problems]
    problems += _missing_files(
        {name: raw for name, raw in _tables(content.get("sources")).items() if name not in read}
    )
    return Inspection(plan, subjects, tuple(dict.fromkeys(problems)))


def _attempt(problems: list[str], read: Callable[..., T], *arguments: Any) -> T | None:
    try:
        return read(*arguments)
    except InputError as error:
        problems += error.problems
        return None


def _tables(sources: Any) -> dict[str, Mapping[str, Any]]:
    """Those of the sources that are tables at all."""
    pairs = sources.items() if isinstance(sources, Mapping) else ()
    return {str(name): raw for name, raw in pairs if isinstance(raw, Mapping)}


def _sound(sources: Any) -> dict[str, Source]:
    """The sources that are in order, in a study that is not: what is wrong with the others is said already."""
    found = {name: _attempt([], validated, Source, raw, name) for name, raw in _tables(sources).items()}
    return {name: with_cine(source) for name, source in found.items() if source is not None}


def _missing_files(sources: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """Of data that cannot be read yet, at least which are not there."""
    lines = []
    for name, raw in sources.items():
        named = {key: raw.get(key) for key in (*WALLS, "images")}
        pressure = raw.get("pressure")
        named |= {"pressure.file": pressure.get("file")} if isinstance(pressure, Mapping) else {}
        lines += [
            f"{name}: {key}: {path}: no such file or folder; correct the path"
            for key, path in named.items()
            if isinstance(path, str) and path and not Path(path).exists()
        ]
    return lines
