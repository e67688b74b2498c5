"""Change one line of the sources at a time and see whether the test named for it fails.

python -m tests.mutations             try the mutants that no test has failed of yet
python -m tests.mutations --all       try all of them
python -m tests.mutations MUTANT ...  try those of these names

The mutants are the rows of docs/measured/mutations.tsv: a text that occurs once in a file below src/heartfit, what
stands instead, and the test that must fail. The last column, the day on which it did, is written here.
"""

import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import astuple, dataclass, fields, replace
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.checkout import PACKAGE, ROOT, copy_project, environment_of

TABLE = ROOT / "docs" / "measured" / "mutations.tsv"
MADE_BY = "# made by: python3 study.py mutations"
PARTS = ("tests", "verification", "pyproject.toml")
"""What tests need besides what a study needs."""

SURVIVED = "survived"
TIMEOUT = 900.0  # s


@dataclass(frozen=True)
class Mutant:
    """In ``file``, ``text`` becomes ``instead``; ``test`` must fail, as it did when it was last tried."""

    mutant: str
    file: str
    text: str
    instead: str
    test: str
    tried: str = ""


class MutationError(RuntimeError):
    """A mutant cannot be made, or its test fails without it."""


def read_mutants(table: Path = TABLE) -> list[Mutant]:
    """The rows of the table."""
    _, _, *rows = table.read_text(encoding="utf-8").splitlines()
    return [Mutant(*row.split("\t")) for row in rows]


def write_mutants(mutants: Sequence[Mutant], table: Path = TABLE) -> None:
    """Store the rows of the table."""
    head = [field.name for field in fields(Mutant)]
    lines = [MADE_BY, *("\t".join(cells) for cells in (head, *map(astuple, mutants)))]
    table.write_text("\n".join(lines) + "\n", encoding="utf-8")


@contextmanager
def mutated(project: Path, mutant: Mutant) -> Iterator[None]:
    """The sources of a project with the mutant; restored with their date, by which compiled kernels are found."""
    file = project / PACKAGE / mutant.file
    original = file.with_suffix(".original")
    count = file.read_text().count(mutant.text)
    if count != 1:
        raise MutationError(f"{mutant.file} has {mutant.text!r} {count} times; expected it once")
    shutil.copy2(file, original)
    file.write_text(file.read_text().replace(mutant.text, mutant.instead))
    try:
        yield
    finally:
        original.replace(file)


def passes(project: Path, *tests: str) -> bool:
    """Run tests of a project until one fails; raises MutationError where they cannot be run."""
    command = [sys.executable, "-m", "pytest", "-x", "-q", "-n", "0", "-p", "no:cacheprovider", *tests]
    environment = environment_of(project) | {"PYTHONPATH": f"{project / 'src'}:{project}"}
    run = subprocess.run(
        command, cwd=project, env=environment, text=True, capture_output=True, timeout=TIMEOUT
    )
    if run.returncode not in (0, 1):
        raise MutationError(f"{' '.join(tests)} cannot be run:\n{run.stdout}{run.stderr}")
    return run.returncode == 0


def tried(project: Path, mutants: Sequence[Mutant]) -> Iterator[Mutant]:
    """The mutants with the day on which their test failed, or SURVIVED."""
    if not passes(project, *{mutant.test for mutant in mutants}):
        raise MutationError("a test fails without a mutant; run the tests first")
    for mutant in mutants:
        with mutated(project, mutant):
            survived = passes(project, mutant.test)
        yield replace(mutant, tried=SURVIVED if survived else datetime.now(UTC).date().isoformat())


def main(arguments: Sequence[str]) -> int:
    """Try mutants and store when; 1 if one survives."""
    mutants = {mutant.mutant: mutant for mutant in read_mutants()}
    untried = [mutant.mutant for mutant in mutants.values() if mutant.tried in ("", SURVIVED)]
    names = [*mutants] if "--all" in arguments else arguments or untried
    if unknown := set(names) - set(mutants):
        sys.exit(f"no mutant {', '.join(sorted(unknown))} in {TABLE.relative_to(ROOT)}")
    with TemporaryDirectory() as folder:
        project = Path(folder) / "project"
        copy_project(project)
        for part in PARTS:
            copy = shutil.copytree if (ROOT / part).is_dir() else shutil.copy
            copy(ROOT / part, project / part)
        for mutant in tried(project, [mutants[name] for name in names]) if names else ():
            mutants[mutant.mutant] = mutant
            write_mutants([*mutants.values()])
            sys.stderr.write(f"{mutant.mutant}: {mutant.tried}\n")
    return int(any(mutants[name].tried == SURVIVED for name in names))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
