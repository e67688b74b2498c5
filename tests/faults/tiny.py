"""Smallest study in a separate folder, which faults may break."""

import hashlib
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from tests.checkout import ROOT, copy_project, environment_of

RESULTS = "results/tiny"
TARGETS = (f"{RESULTS}/tables/numbers.csv", f"{RESULTS}/figures/volunteer1_physical.png")
UNEQUAL = ("logs", "benchmarks", ".sums")
"""Files that depend on times and on the order of jobs."""
PATIENCE = 1800.0  # s


class TinyStudy:
    """Copy of the project; `results` and Snakemake's metadata can be kept and restored."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder / "project"
        self._kept = folder / "kept"
        self.folder.mkdir(parents=True)
        copy_project(self.folder)

    def start(
        self,
        *arguments: str,
        results: str = RESULTS,
        environment: Mapping[str, str] | None = None,
        targets: Iterable[str] = (),
    ) -> "subprocess.Popen[str]":
        """Start a run that makes the tables and the targets, as the leader of a process group."""
        command = [sys.executable, "-m", "snakemake", "--cores", "2", "--configfile", "config/tiny.yaml"]
        paths = [target.replace(RESULTS, results) for target in (*TARGETS, *targets)]
        elsewhere = [] if results == RESULTS else ["--config", f"results={results}"]
        return subprocess.Popen(
            [*command, *elsewhere, *arguments, "--", *paths],
            cwd=self.folder,
            env=environment_of(self.folder) | dict(environment or {}),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )

    def run(self, *arguments: str, targets: Iterable[str] = ()) -> tuple[int, str]:
        """Run to the end; exit code and output."""
        return finish(self.start(*arguments, targets=targets))

    def sums(self, results: str = RESULTS) -> dict[str, str]:
        """SHA-256 of every result by name, except for those that depend on times."""
        root = self.folder / results
        return {
            file.relative_to(root).as_posix(): hashlib.sha256(file.read_bytes()).hexdigest()
            for file in sorted(root.rglob("*"))
            if file.is_file() and file.relative_to(root).parts[0] not in UNEQUAL and not left_over(file)
        }

    def left_over(self) -> list[Path]:
        """Parts of files that were not finished."""
        return [file for file in (self.folder / RESULTS).rglob("*") if left_over(file)]

    def adopt(self, root: Path = ROOT) -> None:
        """Copy existing results of this study from the project, so that a run makes the missing ones only."""
        if (root / RESULTS).is_dir() and (root / ".snakemake" / "metadata").is_dir():
            shutil.copytree(root / RESULTS, self.folder / RESULTS)
            shutil.copytree(root / ".snakemake" / "metadata", self.folder / ".snakemake" / "metadata")

    def keep(self) -> None:
        """Keep the results as they are now."""
        for part in ("results", ".snakemake"):
            shutil.rmtree(self._kept / part, ignore_errors=True)
            shutil.copytree(self.folder / part, self._kept / part)

    def put_back(self) -> None:
        """Restore the kept results."""
        self.wipe()
        for part in ("results", ".snakemake"):
            shutil.copytree(self._kept / part, self.folder / part)

    def wipe(self) -> None:
        """Remove all results."""
        for part in ("results", ".snakemake"):
            shutil.rmtree(self.folder / part, ignore_errors=True)

    @contextmanager
    def edited(self, file: str, old: str, new: str) -> Iterator[None]:
        """Replace a text that a file holds once."""
        path = self.folder / file
        text = path.read_text()
        if text.count(old) != 1:
            raise ValueError(f"{file} has {text.count(old)} times {old!r}; expected one")
        path.write_text(text.replace(old, new))
        try:
            yield
        finally:
            path.write_text(text)

    def remove(self, *parts: str) -> None:
        """Take away some of the results, so that there is something to do."""
        for part in (self.folder / RESULTS / part for part in parts):
            shutil.rmtree(part) if part.is_dir() else part.unlink()


def finish(process: "subprocess.Popen[str]") -> tuple[int, str]:
    """Exit code and output of a run."""
    output, _ = process.communicate(timeout=PATIENCE)
    return process.returncode, output


def kill(process: "subprocess.Popen[str]", after: float) -> bool:
    """Send SIGKILL to the run and all its jobs after some seconds; true if it was still running."""
    time.sleep(after)
    working = process.poll() is None
    if working:
        os.killpg(process.pid, signal.SIGKILL)
    finish(process)
    return working


def left_over(file: Path) -> bool:
    return any(part.startswith(".draft-") for part in file.parts) or file.suffix == ".altered"
