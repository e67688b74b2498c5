"""What can be run of a study, and of which data."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from heartfit.configuration.case import Case
from heartfit.configuration.source import Source
from heartfit.configuration.strict import validated
from heartfit.configuration.study import Study
from heartfit.errors import InputError, require_none
from heartfit.io.cases import read_cases
from heartfit.io.inside import require_inside
from heartfit.io.sources import Subject, examine, with_cine


@dataclass(frozen=True)
class Plan:
    """A study with the cases that can be run, by name, and in one line what is left out, if anything.

    sources: the data of each measured case.
    """

    study: Study
    cases: Mapping[str, Case]
    sources: Mapping[str, Source]
    left_out: str


def plan_study(content: Mapping[str, Any], where: str = "configuration", thorough: bool = True) -> Plan:
    """What can be run of the study that `content` describes; raises InputError before anything is.

    thorough: whether the data of measured cases are read too, as their jobs will.
    """
    plan = outline(content, where)
    if thorough:
        require_none(problem for subject in subjects(plan) for problem in subject.problems)
    return plan


def outline(content: Mapping[str, Any], where: str = "configuration") -> Plan:
    """The plan as configuration and table of cases alone tell it; raises InputErrors."""
    study = validated(Study, content, where)
    require_inside(Path(study.results), "results")
    given = {case.case: case for case in read_cases(Path(study.cases))}
    require_none(_contradictions(study, given))
    folder = next((Path(each) for each in study.measured_heart if Path(each).is_dir()), None)
    usual = None if folder is None else Source.model_validate({"fit": str(folder)})
    sources = {
        name: with_cine(source)
        for name, case in given.items()
        if case.kind == "measured" and (source := study.sources.get(name, usual)) is not None
    }
    cases = {
        name: _as_recorded(case, sources.get(name))
        for name, case in given.items()
        if case.kind == "virtual" or name in sources
    }
    _require_reference(study, cases)
    return Plan(study, cases, sources, _left_out(study, [*given], sources, cases))


def subjects(plan: Plan) -> list[Subject]:
    """The data of every measured case, read as its jobs will."""
    return [examine(plan.cases[name], source) for name, source in plan.sources.items()]


def _as_recorded(case: Case, source: Source | None) -> Case:
    """The case with a catheter where a recording is there."""
    recorded = source is not None and source.pressure is not None
    return case.model_copy(update={"catheter": True}) if recorded else case


def _contradictions(study: Study, cases: Mapping[str, Case]) -> list[str]:
    """What table and sources say of a case that cannot both be."""
    measured = [name for name, case in cases.items() if case.kind == "measured"]
    strangers = [
        f"sources.{name} is of no measured case; known are {', '.join(measured) or 'none'}: correct the name"
        for name in study.sources
        if name not in measured
    ]
    silent = [
        f"{name}: catheter is true and no pressure is given; expected sources.{name}.pressure, or an empty cell"
        for name in measured
        if cases[name].catheter and (name not in study.sources or study.sources[name].pressure is None)
    ]
    nobody = [
        f"discovery.cases: {name!r} is no case of {study.cases}; known are {', '.join(cases)}: correct it"
        for name in study.discovery.cases
        if name not in cases
    ]
    return strangers + silent + nobody


def _require_reference(study: Study, cases: Mapping[str, Case]) -> None:
    if study.sensitivity.case not in cases:
        raise InputError(
            f"sensitivity.case = {study.sensitivity.case!r} is no case that can be run; known are {', '.join(cases)}"
        )


def _left_out(
    study: Study, given: Sequence[str], sources: Mapping[str, Source], cases: Mapping[str, Case]
) -> str:
    absent = [name for name in given if name not in cases]
    if absent:
        return (
            f"{', '.join(absent)} left out: no measured heart in {' or '.join(study.measured_heart)}; "
            "`snakemake --cores 1 fetch_measured_heart` brings it"
        )
    blind = [name for name, source in sources.items() if source.images is None]
    if blind:
        return f"registration of images left out: no images of {', '.join(blind)}, nor a short-axis cine cine/sax*"
    return ""
