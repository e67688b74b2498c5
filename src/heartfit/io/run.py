"""Runs of the workflow: exclusive locks, repair after a killed run, and the logs of jobs.

Snakemake locks its outputs, and the lock of a killed run stays. Therefore each run also holds a lock of the operating
system on a file, which ends with the process: a run that holds it exclusively is alone, and repairs what a killed run
left behind: stale locks, altered files, drafts, dates in the future, and compiled kernels that a power failure cut off,
which numba would fail to load for ever. Each kernel file is a sequence of pickles; their structure is checked without
loading them.
"""

import errno
import os
import pickletools
import shutil
import sys
import time
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from types import TracebackType

from heartfit.core.errors import InputError
from heartfit.io.files import DRAFT, altered, forget


def cut_off(folder: Path) -> list[Path]:
    """Files of compiled kernels that are empty or end in the middle of a pickle."""
    return [file for file in sorted(Path(folder).rglob("*.nb[ci]")) if not _is_whole(file.read_bytes())]


def _is_whole(content: bytes) -> bool:
    stream = BytesIO(content)
    try:
        while stream.tell() < len(content):
            for _ in pickletools.genops(stream):
                pass  # reads one pickle to its end
    except (ValueError, EOFError):
        return False
    return len(content) > 0


def record(path: str) -> None:
    """Redirect standard output and error of this process to the file `path`; an InputError becomes one line there."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    log = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC)
    for stream in (sys.stdout, sys.stderr):
        stream.flush()
        os.dup2(log, stream.fileno())
    os.close(log)
    sys.excepthook = _one_line


DISK_ERRORS = (errno.ENOSPC, errno.EDQUOT, errno.EROFS)
"""Errors of the disk, which are not faults of the program."""


def _one_line(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if isinstance(error, InputError):
        sys.stderr.write(f"{error}\n")
    elif isinstance(error, OSError) and error.errno in DISK_ERRORS:
        sys.stderr.write(f"{error.filename or 'results'}: {error.strerror}; make room and run again\n")
    else:
        sys.__excepthook__(kind, error, trace)


try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

STATE = Path(".snakemake")
SET_ASIDE = ".altered"


class Run:
    """A run in the working directory until close() or the end of the process; InputError without write access."""

    def __init__(self, results: Path, state: Path = STATE, kernels: Path | None = None) -> None:
        self.results, self._state = Path(results), Path(state)
        self._kernels = kernels or Path(os.environ["NUMBA_CACHE_DIR"])  # set on import of heartfit
        try:
            self._state.mkdir(exist_ok=True)
            self._lock = os.open(Path(state, "heartfit.lock"), os.O_RDWR | os.O_CREAT)
        except OSError as refusal:
            raise InputError(f"{Path.cwd()}: {refusal.strerror}; expected a folder to write to") from None
        if self.results.is_dir() and not os.access(self.results, os.W_OK):
            raise InputError(f"{results}: cannot be written to; make it writable, or choose other `results`")
        self.alone = _locked_alone(self._lock)

    def close(self) -> None:
        """Release the lock."""
        os.close(self._lock)

    def put_in_order(self) -> list[str]:
        """Repair the traces of a killed run and return a line for each repair; does nothing during another run."""
        if not self.alone:
            return []
        repairs = [*self._unlock(), *self._set_altered_aside(), *self._date_back(), *self._drop_cut_kernels()]
        for draft in [*self.results.rglob(f"{DRAFT}*")]:
            shutil.rmtree(draft) if draft.is_dir() else draft.unlink()
        _share(self._lock)
        return repairs

    def _unlock(self) -> Iterator[str]:
        """Remove the locks of killed runs."""
        locks = sorted(Path(self._state, "locks").glob("*.lock"))
        for lock in locks:
            lock.unlink()
        if locks:
            yield "an earlier run was killed; its unfinished jobs run again"

    def _set_altered_aside(self) -> Iterator[str]:
        """Rename files whose content differs from their checksum."""
        for file in altered(self.results):
            file.replace(file.with_name(file.name + SET_ASIDE))
            forget(file)
            yield f"{file} was altered: renamed to {file.name}{SET_ASIDE}, computed again where it is needed"

    def _date_back(self) -> Iterator[str]:
        """Set dates in the future to now: such a file would stay newer than all files that depend on it."""
        now = time.time()
        files = [file for file in self.results.rglob("*") if file.is_file() and file.stat().st_mtime > now]
        for file in files:
            os.utime(file, (now, now))
        if files:
            yield f"{len(files)} files in {self.results} had a date in the future, first {files[0]}: set to now"

    def _drop_cut_kernels(self) -> Iterator[str]:
        """Delete compiled kernels that are cut off."""
        broken = cut_off(self._kernels)
        for file in broken:
            file.unlink()
        if broken:
            yield f"{len(broken)} files of compiled kernels in {self._kernels} were cut off: kernels are compiled again"


def _locked_alone(lock: int) -> bool:
    """Return True for an exclusive lock; share the lock if another process holds it."""
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        _share(lock)
        return False
    except (OSError, AttributeError):  # locks are not supported by the file system or the operating system
        return False
    return True


def _share(lock: int) -> None:
    fcntl.flock(lock, fcntl.LOCK_SH)
