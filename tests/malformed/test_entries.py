"""Other entries: the command as a program, and Snakemake, which reads the same input before any job runs."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PATIENCE = 120  # s
MISSPELT, OBJECT = "mseh: {}\n", "results: !!python/object/apply:os.system ['touch hacked']\n"
PROGRAM = ["-c", "import sys; from heartfit.cli.main import main; sys.exit(main())", "check", "--no-picture"]
SNAKEMAKE = ["-m", "snakemake", "-n", "--workflow-profile", "none", "--nolock"]


def run(arguments: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    command, environment = [sys.executable, *arguments], os.environ | {"PYTHONPATH": str(ROOT / "src")}
    return subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, timeout=PATIENCE
    )


@pytest.mark.long
@pytest.mark.parametrize(("text", "message"), [(MISSPELT, "did you mean mesh"), (OBJECT, "tag")])
def test_the_program_refuses_in_one_line(text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "bad.yaml").write_text(text)
    completed = run([*PROGRAM, "--config", str(ROOT / "config" / "config.yaml"), "bad.yaml"], tmp_path)
    assert completed.returncode == 2
    assert any(message in line for line in completed.stderr.splitlines())
    assert all(line.startswith("heartfit: ") for line in completed.stderr.splitlines())
    assert {file.name for file in tmp_path.iterdir()} == {"bad.yaml"}


@pytest.mark.long
@pytest.mark.parametrize(
    ("text", "message"), [(MISSPELT, "did you mean mesh"), (OBJECT, "Config file is not valid JSON or YAML")]
)
def test_snakemake_refuses_before_any_job(text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / "bad.yaml").write_text(text)
    completed = run([*SNAKEMAKE, "--configfile", str(tmp_path / "bad.yaml")], ROOT)
    output = completed.stdout + completed.stderr  # a dry run puts its errors on the standard output
    assert completed.returncode == 1
    assert "Traceback" not in output
    assert sum(message in line for line in output.splitlines()) == 1
    assert "Job stats" not in output
    assert not (ROOT / "hacked").exists()
