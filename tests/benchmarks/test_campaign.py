"""Fifty subjects: ratios of the run to its plan, and the rows of the subjects, which are cases."""

from pathlib import Path

from benchmarks.campaign import configured, subject
from benchmarks.campaign_tables import Ran, forecast_table, snakemake_table
from heartfit.io.configuration import read_cases
from heartfit.study.forecast import Part


def test_the_tables_hold_the_run_beside_the_plan():
    planned = [Part("all", 100, 3600.0, 200, 10.0)] * 2
    runs = [Ran(Path(name), Part("all", 110, 1800.0, 200, 10.0), 600.0, 12.0) for name in ("000", "001")]
    jobs, hours, *_ = forecast_table(planned, runs).to_numpy().tolist()
    assert jobs == ["jobs", "200", "220", "1.100"]
    assert hours == ["CPU h of jobs", "2", "1", "0.500"]
    own = snakemake_table([runs[0], *runs], 2).to_numpy().tolist()
    assert [row[1:] for row in own] == 3 * [["110", "10.0", "12.0", "2.0 %", "1.0 %"]]


def test_the_subjects_of_the_campaign_are_cases(monkeypatch, tmp_path):
    (tmp_path / "config").mkdir()
    tiny = Path(__file__).parents[2] / "config" / "tiny.yaml"
    (tmp_path / "config" / "tiny.yaml").write_text(tiny.read_text())
    monkeypatch.chdir(tmp_path)
    file = configured("many", 50)
    cases = read_cases(file.with_suffix(".tsv"))
    assert [case.case for case in cases] == [f"volunteer{number}" for number in range(1, 51)]
    assert subject(7) == subject(7) != subject(8)
