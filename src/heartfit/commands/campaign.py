"""Commands for studies past one machine: what jobs cost, and what many subjects come to."""

import argparse
from pathlib import Path

from heartfit.commands.options import Command, configuration
from heartfit.configuration.study import Study
from heartfit.errors import InputError
from heartfit.io.cases import read_cases
from heartfit.io.configuration import read_configuration, read_study
from heartfit.io.measured_costs import FOOTPRINTS, NEEDS, read_table, write_costs
from heartfit.planning.footprint import Footprint
from heartfit.planning.forecast import Subjects, forecast
from heartfit.planning.need import Need
from heartfit.planning.page import forecast_page

RESOURCES = Path("resources")


def costs_arguments(command: argparse.ArgumentParser) -> None:
    """Of `costs`."""
    command.add_argument(
        "results", type=Path, nargs="+", help="of studies; of a job that several ran, the first one counts"
    )
    command.add_argument("-o", "--output", type=Path, default=RESOURCES, help="folder of the two tables")


def costs(given: argparse.Namespace) -> int:
    """Write what jobs of studies took and what files they left: what `plan` and the rules rest on."""
    write_costs(given.output, given.results)
    return 0


def plan_arguments(command: argparse.ArgumentParser) -> None:
    """Of `plan`."""
    command.add_argument("--cases", type=_positive, default=10_000, help="subjects")
    command.add_argument("--kind", choices=("measured", "virtual"), default="measured", help="of all of them")
    command.add_argument("--setting", nargs="+", default=[], help="settings; all if not given")
    command.add_argument("--pressure", action="store_true", help="a pressure is recorded too")
    command.add_argument("--cpus", type=_positive, default=200, help="that run jobs at once")
    configuration(command)
    command.add_argument("--costs", type=Path, default=RESOURCES, help="folder of the two tables")


def plan(given: argparse.Namespace) -> int:
    """Print what a study of many subjects comes to: jobs, CPU hours, files, and how to split its graph."""
    study = read_study(given.config)
    rows, prints = read_table(Need, given.costs / NEEDS), read_table(Footprint, given.costs / FOOTPRINTS)
    settings = given.setting or [*study.settings]
    subjects = Subjects(given.cases, given.kind, len(settings), _points(study, settings, given.pressure))
    print(forecast_page(forecast(rows, prints, subjects), subjects, given.cpus), end="")
    return 0


def shards_arguments(command: argparse.ArgumentParser) -> None:
    """Of `shards`."""
    command.add_argument(
        "--size", type=_positive, default=100, help="subjects in each, besides the reference"
    )
    command.add_argument(
        "-o", "--output", type=Path, default=Path("config/shards"), help="folder of all of them"
    )
    configuration(command)


def shards(given: argparse.Namespace) -> int:
    """Split the cases of a study into tables and configurations of studies that run on their own."""
    from heartfit.io.shards import write_shards  # pandas, which few commands need

    study = read_study(given.config)
    read_cases(Path(study.cases))
    over, reference = read_configuration(given.config[1:]), study.sensitivity.case
    written = write_shards(given.output, Path(study.cases), reference, given.size, study.results, over)
    print(f"{len(written)} shards: {written[0]} to {written[-1]}")
    return 0


def _positive(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text}; expected a whole number, one or more")
    return int(text)


def join_arguments(command: argparse.ArgumentParser) -> None:
    """Of `join`."""
    command.add_argument("results", type=Path, nargs="+", help="folders of the shards' results")
    command.add_argument(
        "-o", "--output", type=Path, default=Path("results/joined"), help="folder of the tables"
    )


def join(given: argparse.Namespace) -> int:
    """Write the numbers of all shards as those of one study, and their means; fails where shards disagree."""
    from heartfit.io.shards import read_joined
    from heartfit.io.tables import write_tables
    from heartfit.tables.joined import calibrated, summary

    numbers = read_joined(given.results)
    write_tables(given.output, {"numbers": numbers, "summary": summary(numbers)})
    print(f"{len(calibrated(numbers))} cases of {len(given.results)} shards in {given.output}")
    return 0


def _points(study: Study, settings: list[str], pressure: bool) -> int:
    """Sigma points of a subject under all settings together."""
    unknown = [name for name in settings if name not in study.settings]
    if unknown:
        raise InputError(f"no setting {unknown[0]!r}; known are {', '.join(study.settings)}")
    chosen = [study.settings[name] for name in settings]
    return sum(2 * len((each.seeing_pressure() if pressure else each).estimate) + 1 for each in chosen)


COMMANDS: tuple[Command, ...] = (
    (costs, costs_arguments, "write what jobs of studies took"),
    (plan, plan_arguments, "print what a study of many subjects comes to"),
    (shards, shards_arguments, "split a study of many subjects"),
    (join, join_arguments, "put the numbers of shards together"),
)
