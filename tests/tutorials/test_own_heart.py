"""Tutorial of a user's heart: its commands are run one after the other in a new folder."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.checkout import ROOT, copy_project, environment_of
from tests.documentation.blocks import blocks_of

PAGE = ROOT / "docs" / "own_heart.md"
COARSE = "config/smoke.yaml"
CAUSE = "results/mine/mine/discovery/physical/search/cause.json"


def steps() -> list[str]:
    """Steps of the page in order: the commands of console blocks, and each Python block as a whole."""
    return [
        step.removeprefix("$ ")
        for block in blocks_of(PAGE)
        if block.language in ("console", "python")
        for step in ([block.code] if block.language == "python" else block.code.splitlines())
    ]


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A copy of the project and the commands of an environment."""
    copy_project(tmp_path)
    return tmp_path


def command(step: str) -> list[str]:
    """Command of a step with this Python; the study is coarse, on two cores."""
    if "\n" in step:
        return [sys.executable, "-c", step]
    program, *arguments = step.replace("python3 study.py run", "study").split()
    if program == "study":
        coarse = " ".join(arguments).replace("--configfile", f"--configfile {COARSE}").split()
        return [sys.executable, "-m", "snakemake", "--workflow-profile", "none", "--cores", "2", *coarse]
    assert program == ".venv/bin/heartfit", f"{program} is not run by this test"
    return [
        sys.executable,
        "-c",
        "import sys; from heartfit.cli.main import main; sys.exit(main())",
        *arguments,
    ]


@pytest.mark.long
def test_every_step_of_the_page_ends_well(project: Path) -> None:
    environment = environment_of(project)
    for step in steps():
        sys.stdout.write(f"$ {step}\n")
        completed = subprocess.run(
            command(step), cwd=project, env=environment, capture_output=True, text=True
        )
        sys.stdout.write(f"{completed.stdout[-1000:]}\n")
        assert completed.returncode == 0, f"{step}\n{completed.stdout[-2000:]}\n{completed.stderr[-4000:]}"
    for case in ("mine", "drawn"):
        assert (project / f"results/{case}/figures/{case}_check.png").stat().st_size > 100_000
    assert (project / CAUSE).is_file()
    assert (project / "results/mine/report.html").is_file()
    assert (project / "results/drawn/drawn/curves/measured.csv").is_file()
    assert not list((project / "results").glob("*/*/cohort")), "no virtual heart is made"
