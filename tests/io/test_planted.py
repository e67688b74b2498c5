"""Planted cases on disk: the recording does not reveal the effect; the seal detects every change."""

import base64
from dataclasses import replace
from pathlib import Path

import pytest

from heartfit.core.errors import InputError
from heartfit.discovery.sphere_model.cause import Cause
from heartfit.io.curves import read_curves
from heartfit.io.fingerprint import PACKAGE, modules_below
from heartfit.io.planted import read_conditions_of, read_planted, write_findings
from heartfit.io.planting import write_planted
from heartfit.io.recordings import MEASURED
from heartfit.io.scores import read_scored
from heartfit.io.seals import open_seal, seal
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.case import Answer, plant
from heartfit.synthetic.trial import VOLUME, ScoredDiagnosis

SCRIPTS = Path(__file__).parents[2] / "workflow" / "scripts"

CASE = plant(PlantedPlan(5, "single", ("CatheterOffset",), 2.0, reloaded=True))


def test_recording_and_answer_are_read_back(tmp_path):
    write_planted(CASE, tmp_path / "measured", tmp_path / "sealed")
    assert {file.name for file in (tmp_path / "measured" / "5").iterdir()} == {MEASURED, "legs_raised.csv"}
    curves = read_curves(tmp_path / "measured" / "5" / MEASURED)
    for name, curve in CASE.curves["rest"].items():
        assert curves[name].values == pytest.approx(curve.values)
    assert open_seal(tmp_path / "sealed" / "5.answer", Answer) == CASE.answer


def test_a_seal_keeps_the_departure_of_a_misspecified_heart(tmp_path):
    case = plant(PlantedPlan(5, "none", population="misspecified"))
    write_planted(case, tmp_path / "measured", tmp_path / "sealed")
    assert open_seal(tmp_path / "sealed" / "5.answer", Answer) == case.answer
    recorded = (tmp_path / "measured" / "5" / MEASURED).read_text()
    assert "misspecified" not in recorded


def test_the_seal_is_not_read_in_passing(tmp_path):
    write_planted(CASE, tmp_path / "measured", tmp_path)
    for file in (tmp_path / "measured" / "5" / MEASURED, tmp_path / "5.answer"):
        assert "Catheter" not in file.read_text()


def test_a_changed_answer_breaks_the_seal(tmp_path):
    seal(tmp_path / "a", CASE.answer)
    seal(tmp_path / "b", replace(CASE.answer, kind="none"))
    digest, body = (tmp_path / "a").read_text().split()
    other = (tmp_path / "b").read_text().split()[1]
    (tmp_path / "a").write_text(f"{digest}\n{other}\n")
    with pytest.raises(InputError, match="seal is broken"):
        open_seal(tmp_path / "a", Answer)
    assert base64.b64decode(body)


def test_a_missing_answer_is_reported_in_one_line(tmp_path):
    with pytest.raises(InputError, match="no sealed record") as error:
        open_seal(tmp_path / "none", Answer)
    assert "\n" not in str(error.value)


def test_findings_are_read_back_beside_their_answers(tmp_path):
    write_planted(CASE, tmp_path / "measured", tmp_path / "sealed")
    named = Cause("CatheterOffset", 7.5, 900.0, "Pa", (500.0, 1300.0))
    less = {VOLUME: ScoredDiagnosis("insufficient")}
    finding = ScoredDiagnosis(
        "named", (named,), {"CatheterOffset": 7.5}, {"lv_pressure": 0.7}, 3000, 12.0, less
    )
    write_findings(tmp_path / "findings.json", {"5": finding}, "abc")
    (scored,) = read_scored([tmp_path / "findings.json"], [tmp_path / "sealed"])
    assert scored.finding == finding
    assert scored.answer == CASE.answer
    assert scored.right


def test_recordings_are_read_by_seed(tmp_path):
    write_planted(CASE, tmp_path / "measured", tmp_path / "sealed")
    (recording,) = read_planted(tmp_path / "measured").values()
    assert set(recording.curves) == {"lv_volume", "lv_pressure"}
    assert recording.period == CASE.curves["rest"]["lv_volume"].period
    (conditions,) = read_conditions_of(tmp_path / "measured")
    fuller = conditions["legs_raised"].curves["lv_volume"]
    assert set(conditions) == {"legs_raised"}
    assert fuller.values.max() > recording.curves["lv_volume"].values.max()


def test_the_diagnosing_job_imports_no_code_that_plants_or_opens_a_seal():
    diagnosing = {
        path.relative_to(PACKAGE).as_posix() for path in modules_below(SCRIPTS / "diagnose_planted.py")
    }
    assert "synthetic/trial.py" in diagnosing
    planting = ("case", "hidden", "misspecified", "campaign", "out_of_library", "scoring")
    answers = {f"synthetic/{name}.py" for name in planting}
    assert all((PACKAGE / name).exists() for name in answers)
    assert not diagnosing & (answers | {"io/seals.py", "io/planting.py", "io/scores.py"})
    planting = {path.relative_to(PACKAGE).as_posix() for path in modules_below(SCRIPTS / "plant_effects.py")}
    assert not planting & {"discovery/inference/search.py", "discovery/sphere_model/diagnose.py"}
