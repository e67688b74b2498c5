"""The cells of a table as they are written, by column, and the numbers in them."""

import csv
import re
from math import isinf
from pathlib import Path

from heartfit.errors import InputError
from heartfit.io.text import MEGABYTE, read_text

LARGEST = 64 * MEGABYTE
"""Ten minutes of four signals at 1 kHz take a third of it."""

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
PASCAL = {"mmhg": 133.322368, "kpa": 1e3}
"""By the unit that a column's name ends with, in small letters."""
SEPARATORS = {",": "commas", "\t": "tabs"}


def read_cells(path: Path, separator: str = ",", expected: str = "curves as CSV") -> dict[str, list[str]]:
    """Text by column; empty lines, and those that begin with #, are remarks.

    Raises InputError for what is no text, a table of other separators, a column that has no name or the name of
    another, and a row with more or fewer cells than there are columns.
    """
    lines = [line for line in read_text(path, expected, LARGEST).split("\n") if _counts(line)]
    try:
        header, *rows = csv.reader(lines, delimiter=separator, skipinitialspace=True, strict=True)
    except csv.Error as fault:
        raise InputError(f"{path}: not a table ({fault}); expected {expected}: export it anew") from None
    except ValueError:  # nothing to unpack
        raise InputError(f"{path}: empty; expected {expected}: export it anew") from None
    names = [name.strip() for name in header]
    _require_columns(path, names, separator)
    _require_even(path, names, rows)
    columns = [list(column) for column in zip(*rows, strict=True)] or [[] for _ in names]
    return dict(zip(names, columns, strict=True))


def number(text: str) -> float:
    """The number that a cell holds; raises ValueError for NaN and infinity, and what only Python takes for one."""
    if not NUMBER.fullmatch(text.strip()) or isinf(value := float(text)):
        raise ValueError(f"{text or 'empty'}; expected a finite number")
    return value


def number_in(path: Path, column: str, row: int, text: str) -> float:
    """The number in a row, from 0, of a column; raises InputError that names the place of what is none."""
    try:
        return number(text)
    except ValueError as fault:
        raise InputError(f"{path}: {column} in data row {row + 1} is {fault}: fill or drop the row") from None


def _counts(line: str) -> bool:
    return bool(line.strip(" \r")) and not line.lstrip().startswith("#")


def _require_columns(path: Path, names: list[str], separator: str) -> None:
    if len(names) == 1 and re.search(r"[;,\t]", names[0]):
        raise InputError(
            f"{path}: no {SEPARATORS[separator]} between columns; expected these, and points in numbers: export it anew"
        )
    for place, name in enumerate(names, start=1):
        if not name:
            raise InputError(f"{path}: column {place} has no name; expected one with its unit: name it")
        if name in names[: place - 1]:
            raise InputError(f"{path}: column {name} stands there twice; leave one out")


def _require_even(path: Path, names: list[str], rows: list[list[str]]) -> None:
    for place, row in enumerate(rows, start=1):
        if len(row) != len(names):
            raise InputError(
                f"{path}: data row {place} has {len(row)} cells, expected {len(names)} as there are columns; correct "
                "the row (is the decimal sign a comma?)"
            )
