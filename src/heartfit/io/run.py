"""How a run of the workflow begins: what a killed one left behind is put in order, and nobody else is disturbed.

Snakemake locks what it works on, and the lock of one that was killed stays. So each run holds a lock of the system's
on a file, which goes with the process: a run that gets it alone knows that nobody else is at work here.
"""

import os
import shutil
import time
from collections.abc import Iterator
from pathlib import Path

from heartfit.errors import InputError
from heartfit.io.kept_kernels import cut_off
from heartfit.io.sums import DRAFT, altered, forget

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

STATE = Path(".snakemake")
SET_ASIDE = ".altered"


class Run:
    """A run in the working directory until it is closed or the process ends; InputError if nothing can be written."""

    def __init__(self, results: Path, state: Path = STATE, kernels: Path | None = None) -> None:
        self.results, self._state = Path(results), Path(state)
        self._kernels = kernels or Path(os.environ["NUMBA_CACHE_DIR"])  # set by this package
        try:
            self._state.mkdir(exist_ok=True)
            self._lock = os.open(Path(state, "heartfit.lock"), os.O_RDWR | os.O_CREAT)
        except OSError as refusal:
            raise InputError(f"{Path.cwd()}: {refusal.strerror}; expected a folder to write to") from None
        if self.results.is_dir() and not os.access(self.results, os.W_OK):
            raise InputError(f"{results}: cannot be written to; make it writable, or choose other `results`")
        self.alone = _locked_alone(self._lock)

    def close(self) -> None:
        """Let go of the lock."""
        os.close(self._lock)

    def put_in_order(self) -> list[str]:
        """What was found amiss and mended, a line each; nothing while another run is at work here."""
        if not self.alone:
            return []
        done = [*self._unlock(), *self._set_altered_aside(), *self._date_back(), *self._drop_cut_kernels()]
        for draft in [*self.results.rglob(f"{DRAFT}*")]:
            shutil.rmtree(draft) if draft.is_dir() else draft.unlink()
        _share(self._lock)
        return done

    def _unlock(self) -> Iterator[str]:
        """Take away what keeps a run out that has none beside it."""
        locks = sorted(Path(self._state, "locks").glob("*.lock"))
        for lock in locks:
            lock.unlink()
        if locks:
            yield "a run before this one was killed; its jobs that were under way are done again"

    def _set_altered_aside(self) -> Iterator[str]:
        for file in altered(self.results):
            file.replace(file.with_name(file.name + SET_ASIDE))
            forget(file)
            yield f"{file} is not what was written: set aside as {file.name}{SET_ASIDE}, made again where it is needed"

    def _date_back(self) -> Iterator[str]:
        """A file from the future would be newer than all that is made of it."""
        now = time.time()
        files = [each for each in self.results.rglob("*") if each.is_file() and each.stat().st_mtime > now]
        for file in files:
            os.utime(file, (now, now))
        if files:
            yield f"{len(files)} files in {self.results} had a date in the future, {files[0]} first: it is now"

    def _drop_cut_kernels(self) -> Iterator[str]:
        broken = cut_off(self._kernels)
        for file in broken:
            file.unlink()
        if broken:
            yield f"{len(broken)} files of compiled kernels in {self._kernels} were cut off: they are compiled again"


def _locked_alone(lock: int) -> bool:
    """Lock for this process alone if nobody else has the lock, and else with the others."""
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        _share(lock)
        return False
    except (OSError, AttributeError):  # a file system or an operating system that knows no such locks
        return False
    return True


def _share(lock: int) -> None:
    fcntl.flock(lock, fcntl.LOCK_SH)
