"""Plan of a study: the cases that can be run, their data, and every mistake in configuration and data."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from heartfit.core.errors import InputError, require_none
from heartfit.core.validation import validate
from heartfit.io.configuration import read_cases, read_rows
from heartfit.io.files import require_inside
from heartfit.io.sources import Subject, examine, with_cine
from heartfit.study.case import WALLS, Case, Source
from heartfit.study.study import Study


@dataclass(frozen=True)
class Plan:
    """A study, the cases that can be run by name, and the data of its measured cases.

    left_out: one line about cases or stages that lack data, empty if nothing is left out.
    """

    study: Study
    cases: Mapping[str, Case]
    sources: Mapping[str, Source]
    left_out: str


def plan_study(content: Mapping[str, Any], where: str = "configuration", thorough: bool = True) -> Plan:
    """Plan a study; raises InputError for any mistake before anything is run.

    thorough: read the data of measured cases too, as their jobs will.
    """
    plan = outline(content, where)
    if thorough:
        require_none(problem for subject in subjects(plan) for problem in subject.problems)
    return plan


def outline(content: Mapping[str, Any], where: str = "configuration") -> Plan:
    """Plan a study by configuration and table of cases alone; raises InputError."""
    study = validate(Study, content, where)
    require_inside(Path(study.results), "results")
    listed = {case.case: case for case in read_cases(Path(study.cases))}
    require_none(_contradictions(study, listed))
    folder = study.measured_heart
    usual = Source.model_validate({"fit": folder}) if folder and Path(folder).is_dir() else None
    sources = {
        name: with_cine(source)
        for name, case in listed.items()
        if case.kind == "measured" and (source := study.sources.get(name, usual)) is not None
    }
    cases = {
        name: _as_recorded(case, sources.get(name))
        for name, case in listed.items()
        if case.kind != "measured" or name in sources
    }
    _require_reference(study, cases)
    return Plan(study, cases, sources, _left_out(study, [*listed], sources, cases))


def subjects(plan: Plan) -> list[Subject]:
    """Read the data of every measured case as its jobs will."""
    return [examine(plan.cases[name], source) for name, source in plan.sources.items()]


def _as_recorded(case: Case, source: Source | None) -> Case:
    """Set the catheter of a case that has a pressure recording."""
    recorded = source is not None and source.pressure is not None
    return case.model_copy(update={"catheter": True}) if recorded else case


def _contradictions(study: Study, cases: Mapping[str, Case]) -> list[str]:
    """Contradictions between the table of cases and the configuration, one line each."""
    measured = [name for name, case in cases.items() if case.kind == "measured"]
    unlisted = [
        f"sources.{name} is of no measured case; known are {', '.join(measured) or 'none'}: correct the name"
        for name in study.sources
        if name not in measured
    ]
    unrecorded = [
        f"{name}: catheter is true and no pressure is given; expected sources.{name}.pressure, or an empty cell"
        for name in measured
        if cases[name].catheter and (name not in study.sources or study.sources[name].pressure is None)
    ]
    unknown = [
        f"discovery.{key}: {name!r} is no case of {study.cases}; known are {', '.join(cases)}: correct it"
        for key, names in (("cases", study.discovery.cases), ("walls", study.discovery.walls))
        for name in names or ()
        if name not in cases
    ]
    settings, walls = study.discovery.settings, study.discovery.walls
    unset = (
        [
            f"discovery.walls names {', '.join(walls)} and no setting is searched; "
            "expected discovery.settings, such as [physical]"
        ]
        if walls and not settings
        else []
    )
    unsearched = [
        f"{name} is sealed and no setting is searched; expected discovery.settings, such as [physical]"
        for name, case in cases.items()
        if case.kind == "sealed" and not settings
    ]
    blind = [
        f"settings.{name} observes {', '.join(setting.observe)}, whose errors in virtual images are unknown; "
        f"expected `cases` without {', '.join(case for case in imaged)}"
        for name, setting in study.settings.items()
        if setting.observe
        and (imaged := [case for case in cases if case not in measured and setting.serves(case)])
    ]
    return unlisted + unrecorded + unknown + unset + unsearched + blind


def _require_reference(study: Study, cases: Mapping[str, Case]) -> None:
    if study.sensitivity.case not in cases:
        raise InputError(
            f"sensitivity.case = {study.sensitivity.case!r} is no case that can be run; known are {', '.join(cases)}"
        )


def _left_out(
    study: Study, listed: Sequence[str], sources: Mapping[str, Source], cases: Mapping[str, Case]
) -> str:
    absent = [name for name in listed if name not in cases]
    if absent:
        folder = study.measured_heart or "a folder `measured_heart`"
        return f"{', '.join(absent)} left out: no data under `sources` nor in {folder}; state them"
    unseen = [name for name, source in sources.items() if source.images is None]
    if unseen:
        return f"registration of images left out: no images of {', '.join(unseen)}, nor a short-axis cine cine/sax*"
    return ""


T = TypeVar("T")


@dataclass(frozen=True)
class Inspection:
    """Plan of a study, None after mistakes in configuration or cases; readable data of cases; one line per mistake."""

    plan: Plan | None
    subjects: Sequence[Subject]
    problems: Sequence[str]


def inspect(content: Mapping[str, Any], where: str) -> Inspection:
    """Find all mistakes of a study: one mistake does not hide the others."""
    problems: list[str] = []
    _attempt(problems, validate, Study, content, where)
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
    """Sources that are tables."""
    pairs = sources.items() if isinstance(sources, Mapping) else ()
    return {str(name): raw for name, raw in pairs if isinstance(raw, Mapping)}


def _sound(sources: Any) -> dict[str, Source]:
    """Valid sources of an invalid study; the mistakes of the others are reported with the study."""
    attempts = {name: _attempt([], validate, Source, raw, name) for name, raw in _tables(sources).items()}
    return {name: with_cine(source) for name, source in attempts.items() if source is not None}


def _missing_files(sources: Mapping[str, Mapping[str, Any]]) -> list[str]:
    """Missing files of sources that cannot be read yet, one line each."""
    lines = []
    for name, raw in sources.items():
        paths = {key: raw.get(key) for key in (*WALLS, "images")}
        pressure = raw.get("pressure")
        paths |= {"pressure.file": pressure.get("file")} if isinstance(pressure, Mapping) else {}
        lines += [
            f"{name}: {key}: {path}: no such file or folder; correct the path"
            for key, path in paths.items()
            if isinstance(path, str) and path and not Path(path).exists()
        ]
    return lines
