"""Console command: exit codes, one line for bad input, and the summary of a beat."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from heartfit.cli import main as cli
from heartfit.cli.console import Progress, beat_summary
from heartfit.heart.beat import Beat, failed_beat
from tests.printed import numbers_in

ROOT = Path(__file__).parents[2]


@pytest.fixture(autouse=True)
def in_the_project(monkeypatch):
    monkeypatch.chdir(ROOT)


def test_pages_are_printed(capsys):
    assert cli.main(["parameters"]) == 0
    assert "sigma_0" in capsys.readouterr().out
    assert cli.main(["configuration-schema"]) == 0
    assert capsys.readouterr().out.startswith("{")


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (["check", "--config", "nowhere.yaml"], "nowhere.yaml: no such file"),
        (["simulate", "nowhere.vtu"], "nowhere.vtu: no such file"),
        (["simulate", "x.vtu", "--setting", "fysical"], "known are locking, physical"),
        (["simulate", "x.vtu", "--set", "sigma0=1"], "nearest are"),
        (["simulate", "x.vtu", "--set", "sigma_0"], "expected NAME=VALUE"),
        (["diagnose", "nowhere.csv"], "nowhere.csv: no such file"),
        (
            ["diagnose", "nowhere.csv", "--without", "MitralRegurgitaton"],
            "--without: mechanism 'MitralRegurgitaton' is unknown; did you mean MitralRegurgitation?",
        ),
        (["diagnose", "a.csv", "--against", "b.csv", "--without", "Scar"], "expected it without --condition"),
        (["diagnose", "resources/plausible_beat.csv", "--rr", "0.9"], "no column time_s"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(arguments, expected, capsys):
    assert cli.main(arguments) == 2
    message = capsys.readouterr().err
    assert message.startswith("heartfit: ")
    assert expected in message
    assert message.count("\n") == 1


BEAT_IMPORTS = {
    "command": "import heartfit.cli.main",
    "job": "\n".join(
        re.findall(
            r"^from heartfit.*$", Path(ROOT, "workflow/scripts/simulate_point.py").read_text(), re.MULTILINE
        )
    ),
}


@pytest.mark.parametrize("imports", BEAT_IMPORTS.values(), ids=BEAT_IMPORTS.keys())
def test_a_beat_imports_no_library_that_it_does_not_use(imports: str) -> None:
    slow = {
        "pandas",
        "matplotlib",
        "skfem",
        "wildmeshing",
        "SimpleITK",
        "urllib.request",
        "scipy.ndimage",
        "scipy.sparse",
        "scipy.signal",
        "scipy.special",
        "scipy.optimize",
        "scipy.stats",
        "scipy.spatial",
    }
    script = f"import sys\n{imports}\nprint(*sorted({slow!r} & set(sys.modules)))"
    run = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert run.stdout == "\n", "each import takes 0.02 to 0.4 s of every job"


def test_check_lists_what_is_left_out(tmp_path, capsys):
    (tmp_path / "no_heart.yaml").write_text(f"measured_heart: {tmp_path}/nowhere\n")
    assert cli.main(["check", "--config", "config/config.yaml", str(tmp_path / "no_heart.yaml")]) == 0
    assert "patient1 left out" in capsys.readouterr().out


def test_a_beat_is_summarised_in_clinical_units():
    time = np.linspace(0.0, 1.0, 101)
    volume = 1e-4 + 5e-5 * np.cos(2 * np.pi * time)
    same = dict.fromkeys(("lv", "rv", "aorta", "pulmonary_artery"), np.full(101, 12e3))
    diagnostics = {"beats": 2.0, "cpu_s": 3.0, "drift": 0.01, "wall_volume_loss": 0.02}
    lines = beat_summary(
        Beat(time, {"lv": volume, "rv": volume}, same, {}, 1.0, 0.0, diagnostics=diagnostics)
    )
    assert {2.0, 1.5, 1.0} <= set(numbers_in(lines[0]))
    assert {150.0, 50.0, 66.7, 12.0} <= set(numbers_in(lines[1]))
    assert [unit for unit in ("LV", "mL", "kPa", "%") if unit not in lines[1]] == []


def test_a_failed_beat_gives_its_reason():
    assert beat_summary(failed_beat("beat 1: inverted", 0.8, 0.1, {})) == ["failed: beat 1: inverted"]


def test_progress_estimates_the_rest(monkeypatch, capsys):
    clock = iter([0.0, 0.5, 10.0])
    monkeypatch.setattr("heartfit.cli.console.time.monotonic", lambda: next(clock))
    progress = Progress()
    progress(0.01)
    progress(0.25)
    assert numbers_in(capsys.readouterr().err) == [25.0, 30.0]
