"""The command that says all that is wrong with a study, and draws what was understood of its hearts."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from heartfit.commands.options import STANDARD, Command
from heartfit.console import one_line
from heartfit.io.configuration import read_configuration

if TYPE_CHECKING:  # imported where they are needed: other commands take a second less
    from heartfit.io.inspection import Inspection
    from heartfit.io.sources import Subject
    from heartfit.tables.understood_figure import Understood

COARSE = (0.015, 0.0006)
"""m, edge length and tolerance of the mesh that is drawn: seconds instead of a minute."""


def check_arguments(command: argparse.ArgumentParser) -> None:
    """The arguments of check."""
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
    for line in drawn:
        print(line)
    return 2 if problems else 0


def _say(found: "Inspection", where: str) -> None:
    """What is in order, a line each."""
    assert found.plan is not None
    plan = found.plan
    print(f"configuration: {where} in order, settings {', '.join(plan.study.settings)}")
    print(f"cases: {', '.join(plan.cases)}")
    for subject in found.subjects:
        for line in subject.said(plan.study.filling(subject.case).lv):
            print(f"{subject.case.case}: {line}")
    if plan.left_out:
        print(plan.left_out)


def _draw(found: "Inspection", problems: list[str]) -> list[str]:
    """Pictures of the hearts whose wall could be read, said in a line each; what else hinders one is a problem."""
    assert found.plan is not None
    lines = []
    for subject in found.subjects:
        file = Path(found.plan.study.results, "figures", f"{subject.case.case}_check.png")
        lines += subject.attempt(_picture, subject, file) or []
        problems += [each for each in subject.problems if each not in problems]
    return lines


def _picture(subject: "Subject", file: Path) -> list[str]:
    from heartfit.geometry.mesher import MeshingError
    from heartfit.io.tables import write_figure
    from heartfit.tables.understood_figure import plot_understood

    try:
        heart = _understood(subject)
    except MeshingError as defect:  # of a coarse mesh: the study's finer one may do
        return [f"not drawn: {subject.case.case}: {defect}"]
    if heart is None:
        return []
    write_figure(file, plot_understood(heart))
    return [f"drawn: {file}"]


def _understood(subject: "Subject") -> "Understood | None":
    """The wall filled coarsely and prepared as the study will, moved where it is known how; None if it is not there."""
    from heartfit.electrophysiology.conduction import CONDUCTIONS
    from heartfit.electrophysiology.onset import assign_activation
    from heartfit.electrophysiology.personalise import personalised
    from heartfit.geometry.mesher import fill_wall
    from heartfit.geometry.prepare import prepare
    from heartfit.registration.carry import carry_mesh
    from heartfit.tables.understood_figure import Understood

    heart, case = subject.heart, subject.case
    if subject.wall is None:
        return None
    mesh = prepare(fill_wall(subject.wall, *COARSE, attempts=3))
    mesh = assign_activation(mesh, personalised(mesh, CONDUCTIONS[case.conduction], case.qrs))
    motion = None
    if heart is not None:
        motion = carry_mesh(mesh, heart.surface, heart.positions, heart.times, heart.period)
    return Understood(case.case, case.conduction, mesh, motion, subject.images, subject.pressure)


COMMANDS: tuple[Command, ...] = (
    (check, check_arguments, "say all that is wrong with a study before it runs"),
)
