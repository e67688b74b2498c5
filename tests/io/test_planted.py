"""Planted cases on disk: the recording tells nothing, the seal notices every change."""

import base64
from dataclasses import replace

import pytest

from heartfit.errors import InputError
from heartfit.io.curves import read_curves
from heartfit.io.planted import MEASURED, open_seal, seal, write_planted
from heartfit.planting.case import Plan, plant

CASE = plant(Plan(5, "single", ("CatheterOffset",), 2.0), second_condition=True)


def test_recording_and_answer_are_read_back(tmp_path):
    write_planted(CASE, tmp_path / "measured", tmp_path / "sealed" / "5.answer")
    assert {file.name for file in (tmp_path / "measured").iterdir()} == {MEASURED, "preload.csv"}
    curves = read_curves(tmp_path / "measured" / MEASURED)
    for name, curve in CASE.curves["rest"].items():
        assert curves[name].values == pytest.approx(curve.values)
    assert open_seal(tmp_path / "sealed" / "5.answer") == CASE.answer


def test_the_seal_is_not_read_in_passing(tmp_path):
    write_planted(CASE, tmp_path / "measured", tmp_path / "5.answer")
    for file in (tmp_path / "measured" / MEASURED, tmp_path / "5.answer"):
        assert "Catheter" not in file.read_text()


def test_a_changed_answer_breaks_the_seal(tmp_path):
    seal(tmp_path / "a", CASE.answer)
    seal(tmp_path / "b", replace(CASE.answer, kind="none"))
    digest, body = (tmp_path / "a").read_text().split()
    other = (tmp_path / "b").read_text().split()[1]
    (tmp_path / "a").write_text(f"{digest}\n{other}\n")
    with pytest.raises(InputError, match="seal is broken"):
        open_seal(tmp_path / "a")
    assert base64.b64decode(body)


def test_a_missing_answer_is_told_in_one_line(tmp_path):
    with pytest.raises(InputError, match="no sealed answer") as told:
        open_seal(tmp_path / "none")
    assert "\n" not in str(told.value)
