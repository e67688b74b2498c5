"""Commands for studies beyond one machine: costs of jobs, forecast, shards and their merge."""

import argparse
from pathlib import Path

from heartfit.cli.console import Command, add_configuration
from heartfit.core.errors import InputError
from heartfit.io.campaign import FOOTPRINTS, NEEDS, read_table, write_costs
from heartfit.io.configuration import read_cases, read_configuration, read_study
from heartfit.study.forecast import Footprint, Subjects, forecast, forecast_page
from heartfit.study.need import Need
from heartfit.study.study import Study

RESOURCES = Path("resources")
"""Folder of the tables of measured costs."""


def costs_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `costs`."""
    command.add_argument(
        "results",
        type=Path,
        nargs="+",
        help="folders of results; for a job in several studies, the first one is used",
    )
    command.add_argument("-o", "--output", type=Path, default=RESOURCES, help="folder of the two tables")


def costs(arguments: argparse.Namespace) -> int:
    """Write the measured costs of jobs and the sizes of their files, which `plan` and the workflow use."""
    write_costs(arguments.output, arguments.results)
    return 0


def plan_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `plan`."""
    command.add_argument("--cases", type=_positive, default=10_000, help="number of subjects")
    command.add_argument(
        "--kind", choices=("measured", "virtual"), default="measured", help="kind of the subjects"
    )
    command.add_argument("--setting", nargs="+", default=[], help="settings; those of all cases if not given")
    command.add_argument("--pressure", action="store_true", help="with a recorded left ventricular pressure")
    command.add_argument(
        "--cpus", type=_positive, default=200, help="number of CPUs that run jobs in parallel"
    )
    add_configuration(command)
    command.add_argument("--costs", type=Path, default=RESOURCES, help="folder of the two tables")


def plan(arguments: argparse.Namespace) -> int:
    """Print a forecast of a study of many subjects: jobs, CPU hours, files, and the split of its graph."""
    study = read_study(arguments.config)
    rows, prints = (
        read_table(Need, arguments.costs / NEEDS),
        read_table(Footprint, arguments.costs / FOOTPRINTS),
    )
    settings = arguments.setting or [*study.common_settings()]
    subjects = Subjects(
        arguments.cases, arguments.kind, len(settings), _points(study, settings, arguments.pressure)
    )
    print(forecast_page(forecast(rows, prints, subjects), subjects, arguments.cpus), end="")
    return 0


def shards_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `shards`."""
    command.add_argument(
        "--size", type=_positive, default=100, help="subjects per shard, in addition to the reference"
    )
    command.add_argument(
        "-o", "--output", type=Path, default=Path("config/shards"), help="folder of the shards"
    )
    add_configuration(command)


def shards(arguments: argparse.Namespace) -> int:
    """Split the cases of a study into tables and configurations of independent studies."""
    from heartfit.io.campaign import write_shards  # imported here: needs pandas

    study = read_study(arguments.config)
    read_cases(Path(study.cases))
    overrides, reference = read_configuration(arguments.config[1:]), study.sensitivity.case
    written = write_shards(
        arguments.output, Path(study.cases), reference, arguments.size, study.results, overrides
    )
    print(f"{len(written)} shards: {written[0]} to {written[-1]}")
    return 0


def _positive(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text}; expected a whole number, one or more")
    return int(text)


def join_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `join`."""
    command.add_argument("results", type=Path, nargs="+", help="folders of the shards' results")
    command.add_argument(
        "-o", "--output", type=Path, default=Path("results/joined"), help="folder of the tables"
    )


def join(arguments: argparse.Namespace) -> int:
    """Write the numbers of all shards as those of one study, and their means; fails if shards are inconsistent."""
    from heartfit.io.tables import read_shards, write_tables
    from heartfit.results.provenance import calibrated_cases, merge_shards, summarise_cohort
    from heartfit.results.text import render_tables

    numbers = merge_shards(read_shards(arguments.results))
    write_tables(arguments.output, render_tables({"numbers": numbers, "summary": summarise_cohort(numbers)}))
    print(f"{len(calibrated_cases(numbers))} cases of {len(arguments.results)} shards in {arguments.output}")
    return 0


def _points(study: Study, settings: list[str], pressure: bool) -> int:
    """Return the number of sigma points of a subject over all settings."""
    unknown = [name for name in settings if name not in study.settings]
    if unknown:
        raise InputError(f"no setting {unknown[0]!r}; known are {', '.join(study.settings)}")
    chosen = [study.settings[name] for name in settings]
    return sum(
        2 * len((setting.with_lv_pressure() if pressure else setting).estimate) + 1 for setting in chosen
    )


COMMANDS: tuple[Command, ...] = (
    (costs, costs_arguments, "write the measured costs of jobs of studies"),
    (plan, plan_arguments, "print a forecast of a study of many subjects"),
    (shards, shards_arguments, "split a study of many subjects"),
    (join, join_arguments, "merge the numbers of shards"),
)
