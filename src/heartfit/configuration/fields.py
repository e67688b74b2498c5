"""Kinds of fields that more than one table has."""

import re
from typing import Annotated

from pydantic import AfterValidator, Field

MOST = 10_000

Count = Annotated[int, Field(ge=1, le=MOST)]
"""Of jobs, hearts or steps; more is a mistake that would never end."""

Seed = Annotated[int, Field(ge=0, lt=1 << 63)]

STEP = re.compile(r"[^\W_][\w.-]*")


def _inside(path: str) -> str:
    """A folder that is written into: no absolute path, no .., nothing hidden, no wildcard."""
    if not all(map(STEP.fullmatch, path.split("/"))):
        raise ValueError(
            f"{path!r} is not within the working directory by plain names, and is written into; give a folder such as "
            "results/mine, of letters, digits and . _ -"
        )
    return path


Inside = Annotated[str, AfterValidator(_inside)]

FOLDERS = (
    *(
        "benchmarks",
        "cohort",
        "curves",
        "discovery",
        "discovery_benchmark",
        "figures",
        "geometry",
        "images",
        "logs",
    ),
    *("registration", "registration_error", "sensitivity", "tables", "templates"),
)
"""Of the results; a case or setting of such a name would be laid into one of them."""

NAME = re.compile(r"[A-Za-z][A-Za-z0-9_-]{0,39}")


def _name(name: str) -> str:
    """What names a folder and stands in patterns of paths."""
    if not NAME.fullmatch(name):
        raise ValueError(
            f"{name[:60]!r} is no name; expected a letter, then at most 39 letters, digits, _ and -: rename it"
        )
    if name in FOLDERS:
        raise ValueError(f"{name!r} is the name of a folder of the results; rename it")
    return name


Name = Annotated[str, AfterValidator(_name)]
