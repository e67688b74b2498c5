"""A copy of the workflow that tests may edit, with a library of its own where they edit that, too."""

import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest

from tests.workflow.fork_server import ForkServer

ROOT = Path(__file__).parents[2]
HEART = Path("resources") / "measured_heart"
PARTS = ("Snakefile", "workflow", "config", "resources", "profiles", "docs/templates")


def copied(folder: Path, *parts: str) -> Path:
    """Copy parts of the project without a measured heart, which every plan of a study would read.

    Kernels of a copied library would be compiled again.
    """
    folder.mkdir()
    for part in parts:
        source = ROOT / part
        if source.is_dir():
            ignore = shutil.ignore_patterns("__pycache__", "bivme_patient1", "*.nbc", "*.nbi")
            shutil.copytree(source, folder / part, ignore=ignore)
        else:
            shutil.copy(source, folder / part)
    shutil.rmtree(folder / HEART)
    return folder


@dataclass(frozen=True)
class Run:
    """Exit code of Snakemake, and its output and errors in one."""

    returncode: int
    stdout: str


@dataclass(frozen=True)
class Workflow:
    """A project in its own folder, without any measured heart unless one is linked, and what runs Snakemake."""

    folder: Path
    server: ForkServer

    def snakemake(self, *arguments: str) -> Run:
        """Run Snakemake."""
        printed = self.folder.with_suffix(".log")
        code = self.server.snakemake(self.folder, printed, ("--workflow-profile", "none", *arguments))
        return Run(code, printed.read_text(encoding="utf-8"))

    def link_measured_heart(self, folder: Path) -> None:
        """Link the measured heart."""
        (self.folder / HEART).symlink_to(folder.resolve())

    def add_spoilt_heart(self) -> None:
        """Add empty files in the places of a measured heart."""
        for name in ("control_points/frame_000.txt", "template/ETIndicesSorted.txt"):
            file = self.folder / HEART / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.touch()

    def keep_cases(self, *names: str) -> None:
        """Reduce the study to some of its cases, of which none is sealed."""
        table = self.folder / "config" / "cases.tsv"
        header, *rows = table.read_text(encoding="utf-8").splitlines(keepends=True)
        table.write_text(header + "".join(row for row in rows if row.split("\t")[0] in names))

    def edit(self, file: str, text: str) -> None:
        """Append to a file."""
        with (self.folder / file).open("a") as opened:
            opened.write(text)

    @contextmanager
    def edited(self, file: str, text: str) -> Iterator[None]:
        """Append to a file and restore it afterwards."""
        before = (self.folder / file).read_text(encoding="utf-8")
        self.edit(file, text)
        try:
            yield
        finally:
            (self.folder / file).write_text(before, encoding="utf-8")


@pytest.fixture(scope="session")
def server():
    """Runs Snakemake with the library of the project."""
    with ForkServer(ROOT / "src") as server:
        yield server


@pytest.fixture
def workflow(tmp_path, server):
    return Workflow(copied(tmp_path / "project", *PARTS), server)


@pytest.fixture(scope="module")
def drawing(tmp_path_factory):
    """Workflow with an own library after drawing the sigma points of one case, these points, and the run."""
    folder = copied(tmp_path_factory.mktemp("drawn") / "project", *PARTS, "src")
    with ForkServer(folder / "src") as server:
        workflow = Workflow(folder, server)
        points = "results/volunteer1/physical/calibration/points.json"
        run = workflow.snakemake("--cores", "1", points)
        assert run.returncode == 0
        yield workflow, points, run


@pytest.fixture(scope="module")
def drawn(drawing):
    """The same workflow and points."""
    return drawing[:2]


@pytest.fixture(scope="module")
def planned(tmp_path_factory, server):
    """A dry run of the study as it is, without a measured heart."""
    return Workflow(copied(tmp_path_factory.mktemp("planned") / "project", *PARTS), server).snakemake("-n")
