"""Options that state a recording of the left ventricular pressure in a file of its own."""

import argparse
from typing import Any


def pressure_arguments(command: argparse.ArgumentParser) -> None:
    """Add the options of a recorded pressure."""
    command.add_argument("--pressure", metavar="CSV", help="recording of the left ventricular pressure")
    command.add_argument(
        "--pressure-column", metavar="NAME", help="column of the pressure, if there are several"
    )
    command.add_argument(
        "--pressure-unit",
        choices=("mmHg", "kPa"),
        help="unit of the pressure, if the column's name does not state it",
    )
    command.add_argument(
        "--trigger", metavar="NAME", help="column of the ECG or of a marker in the recording of the pressure"
    )
    command.add_argument(
        "--upstroke",
        type=float,
        metavar="S",
        help="time from the trigger to the steepest rise, if no column marks the trigger",
    )


def stated_pressure(arguments: argparse.Namespace) -> dict[str, Any]:
    """Return the options that are given, in the form of the configuration; empty without any."""
    stated = {
        "file": arguments.pressure,
        "unit": arguments.pressure_unit,
        "column": arguments.pressure_column,
        "trigger": arguments.trigger,
        "upstroke": arguments.upstroke,
    }
    return {name: value for name, value in stated.items() if value is not None}
