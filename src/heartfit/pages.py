"""Pages that the console command prints: parameters, schemas, verification, robustness, limits."""

import argparse
import sys

from heartfit.catalogue import parameter_page
from heartfit.io.configuration import schema

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


PAGES = (parameters, configuration_schema, cause_schema, verification, robustness, detection_limits)
