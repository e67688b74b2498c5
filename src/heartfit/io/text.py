"""Text files of the user, read whole or refused in one line."""

import json
from math import isfinite
from pathlib import Path
from stat import S_ISDIR, S_ISREG
from typing import Any

from heartfit.errors import InputError
from heartfit.io.sums import require_as_written

MEGABYTE = 1 << 20


def require_file(path: Path, expected: str) -> None:
    """Raises InputError for what is missing, a folder, without end as a device or a pipe, or not as a job wrote it."""
    try:
        mode = Path(path).stat().st_mode
    except OSError as fault:
        said = (fault.strerror or "cannot be reached").lower()
        raise InputError(f"{path}: {said}; expected {expected}: correct the path") from None
    except ValueError:  # a NUL in the name
        raise InputError(f"{path}: no such file; expected {expected}: correct the path") from None
    if not S_ISREG(mode):
        found = "is a folder" if S_ISDIR(mode) else "is not a regular file"
        raise InputError(f"{path}: {found}; expected {expected}: correct the path")
    require_as_written(path)


def read_text(path: Path, expected: str, most: int = MEGABYTE) -> str:
    """The text of a file, lines ended by a line feed, without the mark of the byte order.

    expected: what the file is to hold, in words. Raises InputError for what is no file, has more than `most` bytes
    or is not UTF-8.
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
    """The content of a JSON file; raises InputError for what is none, a key that stands twice, and NaN."""
    text = read_text(path, expected)
    try:
        return json.loads(text, object_pairs_hook=_unique, parse_float=_finite, parse_constant=_finite)
    except RecursionError:
        raise InputError(f"{path}: nested without end; expected {expected}: correct it") from None
    except ValueError as fault:
        raise InputError(f"{path}: not JSON ({fault}); expected {expected}: correct it") from None


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    content: dict[str, Any] = {}
    for key, value in pairs:
        if key in content:
            raise ValueError(f"key {key} stands twice")
        content[key] = value
    return content


def _finite(text: str) -> float:
    if not isfinite(number := float(text)):
        raise ValueError(f"{text} is no finite number")
    return number
