"""Commands that print a page or a table."""

import argparse
from pathlib import Path

from heartfit.cli.console import Command, add_no_arguments
from heartfit.core.errors import InputError
from heartfit.io.configuration import schema
from heartfit.personalise.setting import parameter_page

HEARTS = 3
"""Number of hearts per effect from which its detection limit is computed."""


def parameters(_: argparse.Namespace) -> int:
    """Print the reference page of all parameters."""
    print(parameter_page(), end="")
    return 0


def configuration_schema(_: argparse.Namespace) -> int:
    """Print the JSON schema of a configuration."""
    print(schema(), end="")
    return 0


def cause_schema(_: argparse.Namespace) -> int:
    """Print the JSON schema of a cause.json."""
    from heartfit.io import causes

    print(causes.cause_schema(), end="")
    return 0


def detection_limits(_: argparse.Namespace) -> int:
    """Print the smallest detectable size of each effect from a volume and a pressure, within some minutes."""
    from heartfit.discovery.sphere_model.forward_model import BASE_COORDINATES
    from heartfit.discovery.sphere_model.limits import detection_limits
    from heartfit.results.planted_page import limits_page

    print(limits_page(detection_limits(HEARTS), len(BASE_COORDINATES)), end="")
    return 0


def tolerances_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `tolerances`."""
    command.add_argument("numbers", type=Path, help="numbers.csv of a study")
    command.add_argument(
        "table",
        type=Path,
        help="table of tolerances, whose expected numbers are replaced by those of the study",
    )


def tolerances(arguments: argparse.Namespace) -> int:
    """Print a table of tolerances with the numbers of a study as the expected ones."""
    from heartfit.io.tables import read_numbers, read_tolerances  # imported here: needs pandas
    from heartfit.results.provenance import renew_tolerances

    table = renew_tolerances(read_numbers(arguments.numbers), read_tolerances(arguments.table))
    print(table.to_csv(sep="\t", index=False, float_format="%.4g"), end="")
    return 0


MOVED_COMMANDS = {
    "verification": "python -m verification",
    "robustness": "python -m verification robustness",
    "reference": "python -m verification reference MESH",
}
"""Commands that are no longer part of the installed package, and their replacements."""


def refuse_moved_command(_: argparse.Namespace) -> int:
    """Raise InputError with the replacements of the moved commands."""
    verification, robustness, reference = MOVED_COMMANDS.values()
    raise InputError(
        "the checks of the simulator stand beside the package, in a checkout of the sources; run there "
        f"`{verification}`, `{robustness}` or `{reference}`"
    )


def add_ignored_arguments(command: argparse.ArgumentParser) -> None:
    """Accept the old arguments of a moved command, so that an old call is answered with the new command."""
    command.add_argument("arguments", nargs="*", help=argparse.SUPPRESS)


COMMANDS: tuple[Command, ...] = (
    (parameters, add_no_arguments, "print the reference page of all parameters"),
    (configuration_schema, add_no_arguments, "print the JSON schema of a configuration"),
    (cause_schema, add_no_arguments, "print the JSON schema of a cause.json"),
    (
        detection_limits,
        add_no_arguments,
        "print the smallest detectable size of each effect, within some minutes",
    ),
    (
        tolerances,
        tolerances_arguments,
        "print a table of tolerances with the numbers of a study as the expected ones",
    ),
)
