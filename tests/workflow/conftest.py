"""A copy of the workflow that tests may edit, with a library of its own where they edit that, too."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PARTS = ("Snakefile", "workflow", "config", "resources", "profiles", "docs/templates")


class Workflow:
    """A project in its own folder, without any measured heart unless one is linked.

    It has a library of its own if that is to be edited; kernels of a copied library would be compiled again.
    """

    def __init__(self, folder: Path, own_library: bool = False) -> None:
        self.folder = folder
        self.library = (folder if own_library else ROOT) / "src"
        folder.mkdir()
        for part in (*PARTS, *(["src"] if own_library else [])):
            source = ROOT / part
            if source.is_dir():
                ignore = shutil.ignore_patterns("__pycache__", "bivme_patient1", "*.nbc", "*.nbi")
                shutil.copytree(source, folder / part, ignore=ignore)
            else:
                shutil.copy(source, folder / part)

    def snakemake(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Run Snakemake with the project's library; output and errors in one."""
        command = [sys.executable, "-m", "snakemake", "--workflow-profile", "none", *arguments]
        environment = os.environ | {"PYTHONPATH": str(self.library)}
        return subprocess.run(
            command,
            cwd=self.folder,
            env=environment,
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )

    def link_measured_heart(self, folder: Path) -> None:
        """Link the measured heart."""
        (self.folder / "resources" / "bivme_patient1").symlink_to(folder.resolve())

    def add_spoilt_heart(self) -> None:
        """Add empty files in the places of a measured heart."""
        for name in ("control_points/frame_000.txt", "template/ETIndicesSorted.txt"):
            file = self.folder / "resources" / "bivme_patient1" / name
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


@pytest.fixture
def workflow(tmp_path):
    return Workflow(tmp_path / "project")


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    """Workflow after drawing the sigma points of one case, and these points."""
    workflow = Workflow(tmp_path_factory.mktemp("drawn") / "project", own_library=True)
    points = "results/volunteer1/physical/calibration/points.json"
    assert workflow.snakemake("--cores", "1", points).returncode == 0
    return workflow, points


@pytest.fixture(scope="module")
def planned(tmp_path_factory):
    """A dry run of the study as it is, without a measured heart."""
    return Workflow(tmp_path_factory.mktemp("planned") / "project").snakemake("-n")
