"""Commands that print a page or a table."""

import argparse
import sys
from pathlib import Path

import numpy as np

from heartfit.catalogue import parameter_page
from heartfit.commands.options import STANDARD, Command, nothing
from heartfit.io.configuration import read_study, schema
from heartfit.io.meshes import read_prepared_mesh

HEARTS = 3
"""In which an effect is hidden for its detection limit."""


def parameters(_: argparse.Namespace) -> int:
    """print the reference page of all parameters"""
    print(parameter_page(), end="")
    return 0


def configuration_schema(_: argparse.Namespace) -> int:
    """print the JSON schema of a configuration"""
    print(schema(), end="")
    return 0


def cause_schema(_: argparse.Namespace) -> int:
    """print the JSON schema of a cause.json"""
    from heartfit.io import causes  # with what draws the figures

    print(causes.cause_schema(), end="")
    return 0


def verification(_: argparse.Namespace) -> int:
    """print the page of verification, in a minute or two; fails if a check is missed"""
    from heartfit.verification.page import MISSED, verification_page

    page = verification_page()
    print(page, end="")
    return int(MISSED in page)


def robustness(_: argparse.Namespace) -> int:
    """print the page of robustness, in a quarter of an hour"""
    from heartfit.verification.robustness_page import robustness_page

    print(robustness_page(say=lambda text: print(text, file=sys.stderr)), end="")
    return 0


def detection_limits(_: argparse.Namespace) -> int:
    """print how large each effect must be to show in a volume and a pressure, in some minutes"""
    from heartfit.diagnosis.library import BASE
    from heartfit.diagnosis.limits import limits
    from heartfit.tables.limits_table import limits_page

    print(limits_page(limits(HEARTS), len(BASE)), end="")
    return 0


def tolerances_arguments(command: argparse.ArgumentParser) -> None:
    """Of `tolerances`."""
    command.add_argument("numbers", type=Path, help="numbers.csv of a study")
    command.add_argument(
        "table", type=Path, help="the tolerances whose expected numbers are to be those of the study"
    )


def tolerances(given: argparse.Namespace) -> int:
    """Print a table of tolerances with the numbers of a study as the expected ones."""
    from heartfit.io.tables import read_numbers, read_tolerances  # pandas, which no other command needs
    from heartfit.tables.drift import renewed

    table = renewed(read_numbers(given.numbers), read_tolerances(given.table))
    print(table.to_csv(sep="\t", index=False, float_format="%.4g"), end="")
    return 0


def reference_arguments(command: argparse.ArgumentParser) -> None:
    """Of `reference`."""
    command.add_argument(
        "mesh", type=Path, help="ventricles (.vtu) at end diastole, as the study builds them"
    )


def reference(given: argparse.Namespace) -> int:
    """print what the choice of the stress-free reference does to the beat of a mesh, in some minutes"""
    from heartfit.verification.reference import find
    from heartfit.verification.reference_checks import reference_table

    study = read_study([STANDARD])
    loads = np.array([study.end_diastolic_pressure.lv, study.end_diastolic_pressure.rv])
    print(reference_table(find(read_prepared_mesh(given.mesh), loads, study.numerics.numerics())), end="")
    return 0


PAGES = (parameters, configuration_schema, cause_schema, verification, robustness, detection_limits)
COMMANDS: tuple[Command, ...] = (
    *((page, nothing, page.__doc__ or "") for page in PAGES),
    (
        tolerances,
        tolerances_arguments,
        "print a table of tolerances with the numbers of a study as the expected ones",
    ),
    (reference, reference_arguments, reference.__doc__ or ""),
)
