"""Other entries: the command as a program, and Snakemake, which reads the same input before any job runs."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.malformed.configurations import LAUGHS

ROOT = Path(__file__).parents[2]
PATIENCE = 120  # s
SNAKEMAKE = "Config file is not valid JSON or YAML"

BAD = {
    "a misspelt key": ("mseh: {}\n", "unknown key mseh; did you mean mesh"),
    "a path outside": ("results: ../outside\n", "not within the working directory"),
    "a key twice": ("mesh: {edge_length: 0.01}\nmesh: {tolerance: 0.001}\n", "twice"),
    "aliases of aliases": (LAUGHS, "alias"),
    "a Python object": ("results: !!python/object/apply:os.system ['touch hacked']\n", "tag"),
}


def run(command: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    environment = os.environ | {"PYTHONPATH": str(ROOT / "src")}
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=PATIENCE
    )


@pytest.mark.long
@pytest.mark.parametrize("name", BAD)
def test_the_program_refuses_in_one_line(name: str, tmp_path: Path) -> None:
    text, message = BAD[name]
    (tmp_path / "bad.yaml").write_text(text)
    command = [sys.executable, "-c", "import sys; from heartfit.cli.main import main; sys.exit(main())"]
    arguments = ["check", "--no-picture", "--config", str(ROOT / "config" / "config.yaml"), "bad.yaml"]
    completed = run([*command, *arguments], tmp_path)
    assert completed.returncode == 2
    assert any(message in line for line in completed.stderr.splitlines())
    assert all(line.startswith("heartfit: ") for line in completed.stderr.splitlines())
    assert {file.name for file in tmp_path.iterdir()} == {"bad.yaml"}


@pytest.mark.long
@pytest.mark.parametrize("name", BAD)
def test_snakemake_refuses_before_any_job(name: str, tmp_path: Path) -> None:
    text, message = BAD[name]
    (tmp_path / "bad.yaml").write_text(text)
    command = [sys.executable, "-m", "snakemake", "-n", "--workflow-profile", "none", "--nolock"]
    completed = run([*command, "--configfile", str(tmp_path / "bad.yaml")], ROOT)
    output = completed.stdout + completed.stderr  # a dry run puts its errors on the standard output
    expected = SNAKEMAKE if name == "a Python object" else message  # it reads the file first
    assert completed.returncode == 1
    assert "Traceback" not in output
    assert sum(expected in line for line in output.splitlines()) == 1
    assert "Job stats" not in output
    assert not (ROOT / "hacked").exists()
