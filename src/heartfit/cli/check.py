"""Command that checks a study before a run and draws its hearts."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from heartfit.cli.console import STANDARD, Command, one_line
from heartfit.io.configuration import read_configuration

if TYPE_CHECKING:  # imported in the functions that need them: other commands start a second faster
    from heartfit.io.plan import Inspection
    from heartfit.io.sources import Subject
    from heartfit.results.understood import ImportedCase

DRAWN_MESH = (0.015, 0.0006)
"""Edge length and tolerance of the drawn mesh [m], which is made in seconds instead of a minute."""


def check_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `check`."""
    command.add_argument("case", metavar="CASE", nargs="?", help="name of a measured heart, as init wrote it")
    command.add_argument(
        "--config",
        type=Path,
        nargs="+",
        metavar="YAML",
        help="configuration files; later ones override earlier ones",
    )
    command.add_argument(
        "--no-picture", action="store_true", help="omit the pictures, which take seconds per heart"
    )


def check(arguments: argparse.Namespace) -> int:
    """Read all inputs of a study, list every problem, and draw each heart as interpreted by the program."""
    from heartfit.io.plan import inspect

    own = [] if arguments.case is None else [Path(f"config/{arguments.case}.yaml")]
    files = [*(arguments.config or [STANDARD]), *own]
    label = " + ".join(map(str, files))
    inspection = inspect(read_configuration(files), label)
    problems = [*inspection.problems]
    drawn = [] if arguments.no_picture or inspection.plan is None else _draw(inspection, problems)
    for problem in problems:
        print(f"heartfit: {one_line(problem)}", file=sys.stderr)
    if not problems:
        _print_summary(inspection, label)
    for line in drawn:
        print(line)
    return 2 if problems else 0


def _print_summary(inspection: "Inspection", label: str) -> None:
    """Print a line for every valid input."""
    assert inspection.plan is not None
    plan = inspection.plan
    print(f"configuration: {label} in order, settings {', '.join(plan.study.settings)}")
    print(f"cases: {', '.join(plan.cases)}")
    for subject in inspection.subjects:
        for line in subject.summary(plan.study.filling_pressures(subject.case).lv):
            print(f"{subject.case.case}: {line}")
    if plan.left_out:
        print(plan.left_out)


def _draw(inspection: "Inspection", problems: list[str]) -> list[str]:
    """Draw the hearts with a readable wall; return a line per picture, and add further problems to ``problems``."""
    assert inspection.plan is not None
    lines = []
    for subject in inspection.subjects:
        file = Path(inspection.plan.study.results, "figures", f"{subject.case.case}_check.png")
        lines += subject.attempt(_picture, subject, file) or []
        problems += [problem for problem in subject.problems if problem not in problems]
    return lines


def _picture(subject: "Subject", file: Path) -> list[str]:
    from heartfit.geometry.mesher import MeshingError
    from heartfit.io.figures import write_figure
    from heartfit.results.understood import plot_imported_case

    try:
        heart = _understood(subject)
    except MeshingError as defect:  # the coarse mesh failed: the finer one of the study may succeed
        return [f"not drawn: {subject.case.case}: {defect}"]
    if heart is None:
        return []
    write_figure(file, plot_imported_case(heart))
    return [f"drawn: {file}"]


def _understood(subject: "Subject") -> "ImportedCase | None":
    """Mesh the wall coarsely and prepare it as in the study, with its motion if known; None without a wall."""
    from heartfit.geometry.carry import carry_mesh
    from heartfit.geometry.fibres import prepare
    from heartfit.geometry.mesher import fill_wall
    from heartfit.heart.activation.conduction import CONDUCTIONS, assign_activation, fit_conduction
    from heartfit.results.understood import ImportedCase

    heart, case = subject.heart, subject.case
    if subject.wall is None:
        return None
    mesh = prepare(fill_wall(subject.wall, *DRAWN_MESH, attempts=3))
    mesh = assign_activation(mesh, fit_conduction(mesh, CONDUCTIONS[case.conduction], case.qrs))
    motion = None
    if heart is not None:
        motion = carry_mesh(mesh, heart.surface, heart.positions, heart.times, heart.period)
    return ImportedCase(case.case, case.conduction, mesh, motion, subject.images, subject.pressure)


COMMANDS: tuple[Command, ...] = ((check, check_arguments, "list every problem of a study before it runs"),)
