"""The page on one's own heart does what it says: its commands are run one after the other in a new folder."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "own_heart.md"
PARTS = ("Snakefile", "config", "resources", "src", "workflow")
COARSE = "config/smoke.yaml"
CAUSE = "results/mine/mine/discovery/physical/search/cause.json"


def commands() -> list[str]:
    """The lines of the page's console blocks."""
    blocks = re.findall(r"```console\n(.*?)```", PAGE.read_text(), re.DOTALL)
    return [line for block in blocks for line in block.splitlines()]


@pytest.fixture
def project(tmp_path: Path, measured_heart_folder: Path) -> Path:
    """A copy of the project with the published heart, as fetched, and the commands of an environment."""
    for part in PARTS:
        source, ignore = ROOT / part, shutil.ignore_patterns("__pycache__", "bivme_patient1")
        shutil.copytree(source, tmp_path / part, ignore=ignore) if source.is_dir() else shutil.copy(
            source, tmp_path
        )
    (tmp_path / "resources" / "bivme_patient1").symlink_to(measured_heart_folder.resolve())
    return tmp_path


def run(command: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """A command of the page with this Python; the study coarse, on the cores there are."""
    program, *arguments = command.replace("python3 study.py run", "study").split()
    if program == "study":
        first, *others = arguments
        snakemake = [sys.executable, "-m", "snakemake", "--workflow-profile", "none", "--cores", "2"]
        whole = [*snakemake, first, COARSE, *others]
    else:
        assert program == ".venv/bin/heartfit", f"{program} is not run by this test"
        whole = [
            sys.executable,
            "-c",
            "import sys; from heartfit.cli import main; sys.exit(main())",
            *arguments,
        ]
    environment = os.environ | {"PYTHONPATH": str(folder / "src")}
    return subprocess.run(whole, cwd=folder, env=environment, capture_output=True, text=True)


@pytest.mark.long
@pytest.mark.measured
def test_every_command_of_the_page_ends_well(project: Path) -> None:
    ran = commands()
    assert len(ran) >= 4, "init twice, check, run"
    for command in ran:
        done = run(command, project)
        sys.stdout.write(f"$ {command}\n{done.stdout[-1000:]}\n")
        assert done.returncode == 0, f"{command}\n{done.stderr[-4000:]}"
    assert (project / "results/mine/figures/mine_check.png").stat().st_size > 100_000
    assert (project / CAUSE).is_file()
    assert not list((project / "results").glob("*/cohort")), "no virtual heart is made"
