"""Commands for a heart of one's own: write its configuration, and see what was understood of it."""

import argparse
import re
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from heartfit.configuration.own_case import row_text, study_text
from heartfit.configuration.source import Source
from heartfit.configuration.strict import validated
from heartfit.console import one_line
from heartfit.errors import InputError
from heartfit.io.atomic import write_text
from heartfit.io.configuration import read_configuration

if TYPE_CHECKING:  # each is imported by the command that needs it, for others take a second less
    from heartfit.io.inspection import Inspection
    from heartfit.io.sources import Subject
    from heartfit.tables.understood_figure import Understood

STANDARD = Path("config/config.yaml")
NAME = re.compile(r"[A-Za-z][A-Za-z0-9-]*")
COARSE = (0.015, 0.0006)
"""m, edge length and tolerance of the mesh that is drawn: seconds instead of a minute."""


def init_arguments(command: argparse.ArgumentParser) -> None:
    """The arguments of init."""
    command.set_defaults(carry_out=init)
    command.add_argument("case", metavar="CASE", help="its name: letters, digits and hyphens")
    for option, text in (
        ("--fit", "folder in the layout of a biv-me subject"),
        ("--surfaces", "folder of surface meshes, one a phase"),
        ("--segmentation", "label volume at end diastole, or one for each frame"),
        ("--images", "cine: a 4-D file, or a folder"),
        ("--pressure", "CSV of the left ventricle's pressure"),
        ("--pressure-column", "its column, where there are several"),
        ("--trigger", "column of the ECG or of a marker in the CSV"),
    ):
        command.add_argument(
            option, metavar="PATH" if "CSV" not in text and "column" not in text else None, help=text
        )
    command.add_argument(
        "--labels", help="of the segmentation: lv_cavity=1,lv_wall=2,rv_cavity=3[,rv_wall=4]"
    )
    command.add_argument("--end-diastole", type=int, metavar="FRAME", help="of the images, counted from 0")
    command.add_argument(
        "--pressure-unit", choices=("mmHg", "kPa"), help="where the column's name does not say it"
    )
    command.add_argument(
        "--upstroke", type=float, metavar="S", help="after the trigger, where no column says it"
    )
    command.add_argument(
        "--rr", type=float, metavar="S", help="length of the beat; what the data say if not given"
    )
    command.add_argument(
        "--conduction", choices=("healthy", "lbbb"), help="of the heart; to be filled in if not given"
    )
    command.add_argument("--qrs", type=float, metavar="MS", help="duration of the QRS complex")


def init(given: argparse.Namespace) -> int:
    """Write the configuration and the row of a measured heart; without options, to be filled in by hand."""
    from heartfit.io.sources import stated_period

    if not NAME.fullmatch(given.case):
        raise InputError(
            f"init: {given.case!r}; expected a name of letters, digits and hyphens, a letter first"
        )
    if not STANDARD.is_file():
        raise InputError(f"{STANDARD}: no such file; run init in the folder of the project")
    study, row = (Path(f"config/{given.case}.{suffix}") for suffix in ("yaml", "tsv"))
    for file in (study, row):
        if file.exists():
            raise InputError(
                f"{file}: is there already and is left as it is; choose another name or remove it"
            )
    content = _source(given)
    source = validated(Source, content, "init") if content else None
    period = given.rr if given.rr is not None or source is None else stated_period(source)
    write_text(row, row_text(given.case, period, given.conduction, given.qrs))
    write_text(study, study_text(given.case, content or None))
    print(f"wrote {study} and {row}\nnext: heartfit check {given.case}")
    return 0


def _source(given: argparse.Namespace) -> dict[str, Any]:
    """What the options say of the data, as the configuration says it."""
    said = {
        name: getattr(given, name) for name in ("fit", "surfaces", "segmentation", "images", "end_diastole")
    }
    said["labels"] = None if given.labels is None else dict(map(_label, given.labels.split(",")))
    pressure = {
        "file": given.pressure,
        "unit": given.pressure_unit,
        "column": given.pressure_column,
        "trigger": given.trigger,
        "upstroke": given.upstroke,
    }
    said["pressure"] = _without_none(pressure) or None
    return _without_none(said)


def _without_none(content: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in content.items() if value is not None}


def _label(text: str) -> tuple[str, int]:
    name, _, number = text.partition("=")
    if not number.strip().isdecimal():
        raise InputError(f"--labels {text!r}: expected NAME=NUMBER, as lv_cavity=1,lv_wall=2,rv_cavity=3")
    return name.strip(), int(number)


def check_arguments(command: argparse.ArgumentParser) -> None:
    """The arguments of check."""
    command.set_defaults(carry_out=check)
    command.add_argument("case", metavar="CASE", nargs="?", help="a heart of one's own, as init wrote it")
    command.add_argument(
        "--config", type=Path, nargs="+", metavar="YAML", help="later ones over earlier ones"
    )
    command.add_argument(
        "--no-picture", action="store_true", help="draw nothing, which takes seconds for each heart"
    )


def check(given: argparse.Namespace) -> int:
    """Read everything that a study would read, say all that is wrong, and draw what was understood of each heart."""
    from heartfit.io.inspection import inspect

    own = [] if given.case is None else [Path(f"config/{given.case}.yaml")]
    files = [*(given.config or [STANDARD]), *own]
    where = " + ".join(map(str, files))
    found = inspect(read_configuration(files), where)
    problems = [*found.problems]
    drawn = [] if given.no_picture or found.plan is None else _draw(found, problems)
    for problem in problems:
        print(f"heartfit: {one_line(problem)}", file=sys.stderr)
    if not problems:
        _say(found, where)
    for file in drawn:
        print(f"drawn: {file}")
    return 2 if problems else 0


def _say(found: "Inspection", where: str) -> None:
    """What is in order, a line each."""
    assert found.plan is not None
    plan = found.plan
    print(f"configuration: {where} in order, settings {', '.join(plan.study.settings)}")
    print(f"cases: {', '.join(plan.cases)}")
    for subject in found.subjects:
        for line in subject.said(plan.study.end_diastolic_pressure.lv):
            print(f"{subject.case.case}: {line}")
    if plan.left_out:
        print(plan.left_out)


def _draw(found: "Inspection", problems: list[str]) -> list[Path]:
    """A picture of each heart whose wall could be read; what hinders one is added to the problems."""
    from heartfit.io.tables import write_figure
    from heartfit.tables.understood_figure import plot_understood

    assert found.plan is not None
    files = []
    for subject in found.subjects:
        heart = subject.attempt(_understood, subject)
        problems += [each for each in subject.problems if each not in problems]
        if heart is not None:
            files.append(Path(found.plan.study.results, "figures", f"{subject.case.case}_check.png"))
            write_figure(files[-1], plot_understood(heart))
    return files


def _understood(subject: "Subject") -> "Understood | None":
    """The wall filled coarsely and prepared as the study will; None if it could not be read."""
    from heartfit.electrophysiology.conduction import CONDUCTIONS
    from heartfit.electrophysiology.onset import assign_activation
    from heartfit.electrophysiology.personalise import personalised
    from heartfit.geometry.mesher import fill_wall
    from heartfit.geometry.prepare import prepare
    from heartfit.registration.carry import carry_mesh
    from heartfit.tables.understood_figure import Understood

    heart, case = subject.heart, subject.case
    if heart is None:
        return None
    mesh = prepare(fill_wall(heart.surface, *COARSE))
    mesh = assign_activation(mesh, personalised(mesh, CONDUCTIONS[case.conduction], case.qrs))
    motion = carry_mesh(mesh, heart.surface, heart.positions, heart.times, heart.period)
    return Understood(case.case, case.conduction, mesh, motion, subject.images, subject.pressure)
