"""What parsers of other people raise over a file that is not what it says, as one line."""

import lzma
import struct
import warnings
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from heartfit.errors import InputError

FAULTS = (
    *(ArithmeticError, AssertionError, AttributeError, EOFError, LookupError, MemoryError, RuntimeError),
    *(SyntaxError, SystemExit, TypeError, ValueError, Warning, lzma.LZMAError, struct.error, zlib.error),
)
"""A damaged byte may end anywhere in a parser; a fault of the system, as OSError, is not one of the file."""


@contextmanager
def parsing(path: Path, expected: str, *faults: type[BaseException]) -> Iterator[None]:
    """Raises InputError that names the file for whatever a parser raises, `faults` of its own too."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            yield
    except InputError:
        raise
    except FAULTS + faults as fault:
        said = " ".join(str(fault).split())[:120] or type(fault).__name__
        raise InputError(
            f"{path}: cannot be read ({said}); expected {expected}: export or fetch it again"
        ) from None
