"""The log of a job: all that Python and compiled code print goes into one file."""

import errno
import os
import sys
from pathlib import Path
from types import TracebackType

from heartfit.errors import InputError


def record(path: str) -> None:
    """Send standard output and error of this process to `path`; bad input becomes one line there."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    log = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
        os.dup2(log, stream.fileno())
    os.close(log)
    sys.excepthook = _one_line


FULL = (errno.ENOSPC, errno.EDQUOT, errno.EROFS)
"""Refusals of the disk, no fault of the program."""


def _one_line(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if isinstance(error, InputError):
        sys.stderr.write(f"{error}\n")
    elif isinstance(error, OSError) and error.errno in FULL:
        sys.stderr.write(f"{error.filename or 'results'}: {error.strerror}; make room and run again\n")
    else:
        sys.__excepthook__(kind, error, trace)
