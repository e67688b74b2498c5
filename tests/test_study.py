"""Set-up script: its refusals and its additions to Snakemake's lines."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.printed import numbers_in
from tests.sources import script

ROOT = Path(__file__).parents[1]


@pytest.fixture
def study():
    return script("study.py")


def test_the_script_imports_the_standard_library_only():
    check = "import runpy, sys; sys.argv = ['study.py']; runpy.run_path('study.py', run_name='imported')"
    run = subprocess.run([sys.executable, "-I", "-S", "-c", check], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr


def test_an_unknown_command_names_the_known_ones(study):
    run = subprocess.run([sys.executable, "study.py", "tset"], cwd=ROOT, capture_output=True, text=True)
    assert run.returncode == 2
    assert [name for name in ("tset", *study.COMMANDS) if name not in run.stderr.splitlines()[0]] == []


def test_the_remaining_time_is_added_to_the_count_of_steps(study):
    assert numbers_in(study.remaining("20 of 80 steps (25%) done", 120.0)) == [2.0, 6.0]
    assert study.remaining("rule all:", 120.0) == ""


def test_the_study_and_the_readme_state_the_same_duration(study):
    assert f"takes about {study.duration()} minutes on two cores" in (ROOT / "README.md").read_text()


def test_the_environment_is_set_up_once(study, tmp_path, monkeypatch):
    monkeypatch.setattr(study, "STAMP", tmp_path / "stamp")
    monkeypatch.setattr(study, "create_environment", lambda: ["pip"])
    calls = []
    monkeypatch.setattr(study.subprocess, "run", lambda command, check: calls.append(command))
    study.set_up()
    assert len(calls) == 2
    study.set_up()
    assert len(calls) == 2
    monkeypatch.setattr(study, "LOCK", ROOT / "LICENSE")
    study.set_up()
    assert len(calls) == 4


def test_a_python_without_ensurepip_and_pip_is_refused_with_advice(study, monkeypatch):
    monkeypatch.setattr(study.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(SystemExit, match="neither ensurepip nor pip"):
        study.create_environment()


def test_the_lock_names_no_address():
    assert "://" not in (ROOT / "requirements.lock").read_text()


STUDY, HEART = [], ["config/measured_heart.yaml"]
COARSE, COARSE_HEART = ["config/smoke.yaml"], [*HEART, "config/measured_heart_smoke.yaml"]


@pytest.mark.parametrize(
    ("command", "arguments", "codes", "expected"),
    [
        ("run", [], [0, 0, 0], [STUDY, STUDY, HEART]),
        ("run", [], [0, 1, 0], [STUDY, STUDY, HEART]),
        ("run", [], [1], [STUDY]),
        ("smoke", [], [0, 0, 0], [COARSE, COARSE, COARSE_HEART]),
        ("run", ["--configfile", "config/smoke.yaml"], [0], [COARSE]),
    ],
    ids=["the whole study", "one that lost a finding", "a failed one", "a coarse one", "with arguments"],
)
def test_the_measured_heart_follows_the_study_and_its_card_is_printed(
    study, tmp_path, monkeypatch, capsys, command, arguments, codes, expected
):
    monkeypatch.setattr(study, "ROOT", tmp_path)
    calls, outcomes = [], iter(codes)

    def snakemake(arguments, left_out=None):
        calls.append([*arguments])
        if left_out is not None:
            left_out.add("mine left out: no data")
        return next(outcomes)

    monkeypatch.setattr(study, "snakemake", snakemake)
    monkeypatch.setattr(study, "duration", lambda: "29")
    folders = {
        "run": ("results", "results/measured_heart"),
        "smoke": ("results/smoke", "results/measured_heart_smoke"),
    }[command]
    for file in ("patient1/discovery/physical/cause.md", "tables/patient1_physical_extension.md"):
        (tmp_path / folders[1] / file).parent.mkdir(parents=True)
        (tmp_path / folders[1] / file).write_text(f"text of {file}")
    for folder in folders:
        (tmp_path / folder / "tables").mkdir(parents=True, exist_ok=True)
        (tmp_path / folder / study.AGREEMENT).write_text(f"The tables of {folder} agree.\n")
    assert getattr(study, command)(arguments) == max(codes)
    assert [[text for text in call if text.endswith(".yaml")] for call in calls] == expected
    targets = [[text for text in call if text.startswith(("check", "discover"))] for call in calls]
    assert targets == [[], ["check_numbers"], ["discover", "check_discovered"]][: len(codes)]
    printed = capsys.readouterr().out
    assert ("text of patient1/discovery" in printed) == (len(codes) == 3)
    assert ("text of tables/patient1" in printed) == (len(codes) == 3)
    last = printed.splitlines()[-3:]
    expected_last = [
        "mine left out: no data",
        *(f"{folder}: The tables of {folder} agree." for folder in folders),
    ]
    assert (last == expected_last) == (len(codes) == 3)


def test_lines_on_what_is_left_out_are_collected(study, monkeypatch):
    lines = (
        "print('mine left out: no data'); print('1 of 2 steps (50%) done'); print('mine left out: no data')"
    )
    monkeypatch.setattr(study, "tool", lambda *arguments: [sys.executable, "-c", lines])
    left_out = set()
    assert study.snakemake([], left_out) == 0
    assert left_out == {"mine left out: no data"}
