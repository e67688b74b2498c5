"""Text files, JSON and the cells of tables, read completely or refused in one line."""

import csv
import json
import lzma
import re
import struct
import warnings
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from math import isfinite, isinf
from pathlib import Path
from stat import S_ISDIR, S_ISREG
from typing import Any

from heartfit.core.errors import InputError
from heartfit.io.files import require_as_written

FAULTS = (
    *(ArithmeticError, AssertionError, AttributeError, EOFError, LookupError, MemoryError, RuntimeError),
    *(SyntaxError, SystemExit, TypeError, ValueError, Warning, lzma.LZMAError, struct.error, zlib.error),
)
"""Errors that a damaged file can cause anywhere in a parser; OSError, a fault of the system, is not among them."""


@contextmanager
def parsing(path: Path, expected: str, *faults: type[BaseException]) -> Iterator[None]:
    """Turn every error of a parser, including its `faults`, into an InputError that names the file."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            yield
    except InputError:
        raise
    except FAULTS + faults as fault:
        message = " ".join(str(fault).split())[:120] or type(fault).__name__
        raise InputError(
            f"{path}: cannot be read ({message}); expected {expected}: export or fetch it again"
        ) from None


MEGABYTE = 1 << 20


def require_file(path: Path, expected: str) -> None:
    """Raise InputError for a missing file, a folder, a device or a pipe, and a file altered after a job wrote it."""
    try:
        mode = Path(path).stat().st_mode
    except OSError as fault:
        problem = (fault.strerror or "cannot be reached").lower()
        raise InputError(f"{path}: {problem}; expected {expected}: correct the path") from None
    except ValueError:  # a NUL in the name
        raise InputError(f"{path}: no such file; expected {expected}: correct the path") from None
    if not S_ISREG(mode):
        problem = "is a folder" if S_ISDIR(mode) else "is not a regular file"
        raise InputError(f"{path}: {problem}; expected {expected}: correct the path")
    require_as_written(path)


def read_text(path: Path, expected: str, most: int = MEGABYTE) -> str:
    """Read UTF-8 text with line feeds as line ends and without byte order mark.

    expected: description of the content, for messages. Raises InputError for a missing file, for more than `most`
    bytes, and for text that is not UTF-8.
    """
    require_file(path, expected)
    size = Path(path).stat().st_size
    if size > most:
        raise InputError(
            f"{path}: {size / MEGABYTE:.1f} MB; expected at most {most / MEGABYTE:g} MB of {expected}: correct the path"
        )
    try:
        return Path(path).read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as fault:
        raise InputError(
            f"{path}: not UTF-8 text (byte {fault.start + 1}); expected {expected}: save it as UTF-8"
        ) from None


def read_json(path: Path, expected: str) -> Any:
    """Read a JSON file; raises InputError for other content, a key that occurs twice, and NaN."""
    text = read_text(path, expected)
    try:
        return json.loads(text, object_pairs_hook=_unique, parse_float=_finite, parse_constant=_finite)
    except RecursionError:
        raise InputError(f"{path}: nested too deeply; expected {expected}: correct it") from None
    except ValueError as fault:
        raise InputError(f"{path}: not JSON ({fault}); expected {expected}: correct it") from None


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    content: dict[str, Any] = {}
    for key, value in pairs:
        if key in content:
            raise ValueError(f"key {key} occurs twice")
        content[key] = value
    return content


def _finite(text: str) -> float:
    if not isfinite(number := float(text)):
        raise ValueError(f"{text} is not a finite number")
    return number


LARGEST = 64 * MEGABYTE
"""Largest table [bytes]; ten minutes of four signals at 1 kHz take a third of it."""

NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
PASCAL = {"mmhg": 133.322368, "kpa": 1e3}
"""Pascal in a unit of pressure, by its name in small letters at the end of a column's name."""
SEPARATORS = (";", "\t", ",")
"""Separators of columns, of which the first that stands in the header separates the table."""
DECIMAL_COMMA = re.compile(r"\s*[+-]?\d*,\d+(e[+-]?\d+)?\s*", re.IGNORECASE | re.ASCII)


def read_cells(path: Path, separator: str = "", expected: str = "curves as CSV") -> dict[str, list[str]]:
    """Read the cells of a table by column; empty lines and lines that begin with # are skipped.

    separator: one of SEPARATORS, that of the header if empty. Between semicolons and tabs, numbers of a table without
    any point may have decimal commas, which become points. Raises InputError for a file that is not text, other
    separators, a column without a name or with the name of another, and a row with another number of cells than there
    are columns.
    """
    lines = [line for line in read_text(path, expected, LARGEST).split("\n") if _is_row(line)]
    separator = separator or next((mark for mark in SEPARATORS if lines and mark in lines[0]), ",")
    try:
        header, *rows = csv.reader(lines, delimiter=separator, skipinitialspace=True, strict=True)
    except csv.Error as fault:
        raise InputError(f"{path}: not a table ({fault}); expected {expected}: export it again") from None
    except ValueError:  # no header to unpack
        raise InputError(f"{path}: empty; expected {expected}: export it again") from None
    names = [name.strip() for name in header]
    _require_columns(path, names)
    _require_even(path, names, rows)
    if separator != "," and not any("." in cell for row in rows for cell in row):
        rows = [[_with_decimal_point(cell) for cell in row] for row in rows]
    columns = [list(column) for column in zip(*rows, strict=True)] or [[] for _ in names]
    return dict(zip(names, columns, strict=True))


def _with_decimal_point(cell: str) -> str:
    return cell.replace(",", ".") if DECIMAL_COMMA.fullmatch(cell) else cell


def number(text: str) -> float:
    """Parse the number of a cell; raises ValueError for NaN, infinity, and notations that only Python accepts."""
    if not NUMBER.fullmatch(text.strip()) or isinf(value := float(text)):
        raise ValueError(f"{text or 'empty'}; expected a finite number")
    return value


def number_in(path: Path, column: str, row: int, text: str) -> float:
    """Parse the number in a row, from 0, of a column; raises InputError that names column and row."""
    try:
        return number(text)
    except ValueError as fault:
        raise InputError(f"{path}: {column} in data row {row + 1} is {fault}: fill or drop the row") from None


def _is_row(line: str) -> bool:
    return bool(line.strip(" \r")) and not line.lstrip().startswith("#")


def _require_columns(path: Path, names: list[str]) -> None:
    if len(names) == 1 and re.search(r"[;,\t]", names[0]):
        raise InputError(
            f"{path}: no tabs between columns; expected these, and decimal points: export it again"
        )
    for place, name in enumerate(names, start=1):
        if not name:
            raise InputError(f"{path}: column {place} has no name; expected one with its unit: name it")
        if name in names[: place - 1]:
            raise InputError(f"{path}: column {name} occurs twice; remove one")


def _require_even(path: Path, names: list[str], rows: list[list[str]]) -> None:
    for place, row in enumerate(rows, start=1):
        if len(row) != len(names):
            raise InputError(
                f"{path}: data row {place} has {len(row)} cells, expected {len(names)} as there are columns; correct "
                "the row (is the decimal sign a comma?)"
            )
