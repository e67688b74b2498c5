"""`init` writes files that `check` accepts, and overwrites none; unfilled entries and all mistakes are reported."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from heartfit.cli.main import main
from heartfit.io.configuration import read_cases, read_configuration, read_study
from heartfit.io.plan import plan_study

ROOT = Path(__file__).parents[2]


@pytest.fixture
def project(tmp_path, monkeypatch):
    """Working directory with the configuration only."""
    (tmp_path / "config").mkdir()
    shutil.copy(ROOT / "config" / "config.yaml", tmp_path / "config")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def lines(capsys):
    """Lines of standard error, one mistake per line."""
    errors = capsys.readouterr().err.splitlines()
    assert all(line.startswith("heartfit: ") for line in errors)
    return errors


def record(folder, **columns):
    file = folder / "pressure.csv"
    np.savetxt(
        file, np.column_stack(list(columns.values())), "%.5f", ",", header=",".join(columns), comments=""
    )
    return str(file)


def test_unfilled_entries_are_refused_line_by_line(project, capsys):
    assert main(["init", "heart1"]) == 0
    assert main(["check", "heart1"]) == 2
    errors = "\n".join(lines(capsys))
    for place in ("labels.lv_cavity", "labels.lv_wall", "labels.rv_cavity", "period", "conduction"):
        assert f"{place} = 'FILL_IN'" in errors
    for place in ("segmentation", "images"):
        assert f"heart1: {place}: FILL_IN: no such file or folder" in errors
    assert not (project / "results").exists()


def test_no_file_is_overwritten(project, capsys):
    assert main(["init", "heart1", "--fit", "fit", "--rr", "0.8"]) == 0
    before = (project / "config" / "heart1.yaml").read_text()
    assert main(["init", "heart1"]) == 2
    assert "config/heart1.yaml: is there already" in lines(capsys)[0]
    assert (project / "config" / "heart1.yaml").read_text() == before


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (["../heart1"], "expected a name of letters"),
        (["heart1", "--fit", "a", "--surfaces", "b"], "fit and surfaces given for the wall"),
        (["heart1", "--segmentation", "a", "--labels", "lv_cavity:1"], "expected NAME=NUMBER"),
        (["heart1", "--segmentation", "a", "--labels", "lv=1"], "labels.lv_cavity is missing"),
        (["heart1", "--fit", "a", "--trigger", "ecg"], "pressure.file is missing"),
        (["heart1", "--pressure", "a.csv"], "no source given for the wall"),
    ],
)
def test_contradicting_options_write_no_file(project, capsys, options, expected):
    assert main(["init", *options]) == 2
    assert expected in lines(capsys)[0]
    assert [file.name for file in (project / "config").iterdir()] == ["config.yaml"]


@pytest.mark.parametrize("below", ["config", "smoke", "planted"])
def test_no_case_of_the_study_below_is_left(project, below):
    """A configuration over any other names only cases of its own table."""
    shutil.copy(ROOT / "config" / f"{below}.yaml", project / "config")
    assert main(["init", "heart1", "--fit", "nowhere", "--rr", "0.8", "--conduction", "healthy"]) == 0
    files = [Path(f"config/{name}.yaml") for name in ("config", below, "heart1")]
    plan = plan_study(read_configuration(files), thorough=False)
    assert list(plan.cases) == ["heart1"]


def test_paths_with_quotes_colons_and_other_letters_are_kept(project):
    odd = 'a: "b" # ünïcödé'
    assert main(["init", "heart1", "--fit", odd, "--rr", "0.8", "--conduction", "healthy"]) == 0
    assert read_configuration([Path("config/heart1.yaml")])["sources"]["heart1"]["fit"] == odd


def test_every_mistake_is_reported_at_once(project, capsys):
    """One mistake each in the configuration, in the row, and in a data file."""
    times = np.arange(0.0, 0.8, 0.01)
    file = record(project, time_s=times, lv_pressure=8e3 + 7e3 * np.cos(8.0 * times))
    assert main(["init", "heart1", "--fit", "nowhere", "--rr", "0.8", "--pressure", file]) == 0
    study = project / "config" / "heart1.yaml"
    study.write_text(study.read_text() + "mehs: {}\n")
    assert main(["check", "heart1"]) == 2
    errors = lines(capsys)
    assert [
        part for part in ("unknown key mehs", "conduction = 'FILL_IN'") if not any(part in x for x in errors)
    ] == []
    assert any("nowhere: no such file or folder" in line for line in errors)
    row = project / "config" / "heart1.tsv"
    row.write_text(row.read_text().replace("FILL_IN", "healthy"))
    assert main(["check", "heart1"]) == 2
    errors = lines(capsys)
    assert any("nowhere/control_points: missing" in line for line in errors)
    assert any("column lv_pressure has no unit" in line for line in errors), (
        "the data are read despite other mistakes"
    )


@pytest.mark.parametrize(("pressure", "expected"), [(12.0, 12.0 * 133.322368), (-2.0, None)])
def test_the_pressure_at_the_trigger_is_the_filling_pressure(project, pressure, expected):
    times = np.arange(0.0, 0.8, 0.005)
    systole = np.where(times < 0.4, 100.0 * np.sin(np.pi * times / 0.4) ** 2, 0.0)
    file = record(project, time_s=times, lv_pressure_mmhg=pressure + systole)
    options = ["--rr", "0.8", "--conduction", "healthy", "--pressure", file]
    assert main(["init", "heart1", "--fit", "nowhere", *options]) == 0
    [case] = read_cases(project / "config" / "heart1.tsv")
    study = read_study([Path("config/config.yaml")])
    usual = study.end_diastolic_pressure
    assert study.filling_pressures(case).rv == usual.rv
    assert study.filling_pressures(case).lv == pytest.approx(
        usual.lv if expected is None else expected, rel=2e-2
    )


def test_a_measured_heart_is_described(project, capsys, measured_heart_folder):
    folder = str(measured_heart_folder.resolve())
    assert main(["init", "heart1", "--fit", folder, "--conduction", "healthy"]) == 0
    assert "\t0.8288\thealthy" in (project / "config" / "heart1.tsv").read_text(), (
        "the period is read from the data"
    )
    assert main(["check", "heart1", "--no-picture"]) == 0
    assert "heart1: surfaces in 25 phases, beat of 0.829 s" in capsys.readouterr().out
