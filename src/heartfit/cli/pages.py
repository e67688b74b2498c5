"""Commands that print a page or a table."""

import argparse
from pathlib import Path

from heartfit.cli.console import Command, add_no_arguments
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
    from heartfit.discovery.sphere_model.limits import detection_limits
    from heartfit.results.limits_table import limits_table

    print(limits_table(detection_limits(HEARTS)).to_csv(sep="\t", index=False), end="")
    return 0


def drift_arguments(command: argparse.ArgumentParser) -> None:
    """Add the arguments of `drift`."""
    command.add_argument("tables", type=Path, help="folder of the tables of a study, such as results/tables")
    command.add_argument(
        "reference", type=Path, help="folder of the stored tables, such as resources/reference/study"
    )
    command.add_argument(
        "--renew", action="store_true", help="store these tables instead, after a deliberate change"
    )


def drift(arguments: argparse.Namespace) -> int:
    """Print every cell in which the tables of a study differ from the stored ones; 1 if one drifted that is judged."""
    from heartfit.io import reference as stored_tables  # imported here: needs pandas

    tables, folder = stored_tables.read_held_tables(arguments.tables), arguments.reference
    if arguments.renew and not folder.exists():
        stored_tables.write_reference(folder, tables)
        print(f"{folder}: {len(tables)} tables stored for the first time")
        return 0
    stored = stored_tables.read_reference(folder)
    outcome = stored.compared(tables, stored_tables.machine())
    where = "this machine" if outcome.same_machine else "another machine"
    where += "" if outcome.judged else ", and not judged: no ensemble was run"
    print(
        f"{len(outcome.moves)} of {outcome.cells} cells differ, {len(outcome.drifted)} drifted; stored on {where}"
    )
    print("".join(f"  {move}\n" for move in outcome.moves), end="")
    further = sorted(tables.keys() - stored.tables.keys())
    print(f"not held: {', '.join(further)}\n" if further else "", end="")
    if arguments.renew:
        stored_tables.write_reference(folder, tables)
    return int(bool(outcome.drifted) and outcome.judged and not arguments.renew)


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
        drift,
        drift_arguments,
        "compare the tables of a study with stored ones, or store them",
    ),
)
