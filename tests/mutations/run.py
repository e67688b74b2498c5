"""Apply each mutant to a copy of the sources and see whether its tests fail."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.mutations.mutant import Mutant

ROOT = Path(__file__).parents[2]
PARTS = ("src", "verification", "tests", "config", "docs", "resources", "pyproject.toml")
PASSED, FAILED = 0, 1
TIMEOUT = 900.0  # s


class MutationError(RuntimeError):
    """The tests fail without a mutant, or a mutant cannot be made."""


@dataclass(frozen=True)
class Verdict:
    """Verdict on a mutant: the first failed test, empty if it survived."""

    mutant: Mutant
    caught_by: str


class Copy:
    """Copy of the project in a separate folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        for part in PARTS:
            source, target = ROOT / part, folder / part
            if source.is_dir():
                shutil.copytree(source, target, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy(source, target)

    @contextmanager
    def mutated(self, mutant: Mutant) -> Iterator[None]:
        """The copy with the mutant, restored afterwards."""
        file = self.folder / "src" / "heartfit" / mutant.file
        text = file.read_text()
        if text.count(mutant.old) != 1:
            raise MutationError(
                f"{mutant.file} has {text.count(mutant.old)} times {mutant.old!r}; expected one"
            )
        file.write_text(text.replace(mutant.old, mutant.new))
        try:
            yield
        finally:
            file.write_text(text)

    def first_failure(self, tests: str) -> str:
        """Run the tests until one fails; its name, or an empty text if all pass.

        Kernels are recompiled: numba does not detect changes of called kernels in other files.
        """
        with TemporaryDirectory() as kernels:
            run = subprocess.run(
                [
                    sys.executable,
                    "-m",
                    "pytest",
                    "-x",
                    "-q",
                    "-n",
                    "0",
                    "-p",
                    "no:cacheprovider",
                    *tests.split(),
                ],
                cwd=self.folder,
                env=os.environ
                | {"PYTHONPATH": f"{self.folder / 'src'}:{self.folder}", "NUMBA_CACHE_DIR": kernels},
                text=True,
                capture_output=True,
                timeout=TIMEOUT,
            )
        if run.returncode not in (PASSED, FAILED):
            raise MutationError(f"{tests} cannot be run:\n{run.stdout}{run.stderr}")
        failed = re.search(r"^(?:FAILED|ERROR) tests/(\S+)", run.stdout, re.MULTILINE)
        return failed[1] if failed else ""


def verdicts(mutants: Sequence[Mutant]) -> Iterator[Verdict]:
    """Verdicts on the mutants; raises MutationError if tests fail without a mutant."""
    with TemporaryDirectory() as folder:
        copy = Copy(Path(folder) / "project")
        for tests in dict.fromkeys(mutant.tests for mutant in mutants):
            if failure := copy.first_failure(tests):
                raise MutationError(f"{failure} fails without a mutant")
        for mutant in mutants:
            with copy.mutated(mutant):
                yield Verdict(mutant, copy.first_failure(mutant.tests))
