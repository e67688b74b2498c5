"""The diagnosis never opens an answer and is the same without one."""

import sys
from dataclasses import replace

import pytest

from heartfit.discovery.sphere_model import forward_model as library
from heartfit.io.planted import read_planted, write_findings
from heartfit.io.planting import write_planted
from heartfit.io.scores import read_scored
from heartfit.io.seals import seal
from heartfit.roles import registered
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.case import plant
from heartfit.synthetic.trial import ScoredDiagnosis, diagnose_recording

pytestmark = pytest.mark.usefixtures("coarse_search")
CASE = plant(PlantedPlan(11, "single", ("CatheterOffset",), 2.5))
WATCHED = []


def _watch(event, arguments):
    if event == "open" and WATCHED:
        WATCHED.append(str(arguments[0]))


sys.addaudithook(_watch)


@pytest.fixture
def small_library(monkeypatch):
    """An instrument needs no simulation."""
    monkeypatch.setattr(library, "registered", lambda: {"CatheterOffset": registered()["CatheterOffset"]})


def diagnosed(folder):
    """The verdict, and every file that was opened for it."""
    WATCHED[:] = ["watching"]
    (recording,) = read_planted(folder / "measured").values()
    finding = diagnose_recording(recording)
    opened = WATCHED[1:]
    WATCHED.clear()
    return replace(finding, seconds=0.0), opened


def test_no_answer_is_opened_and_none_is_needed(tmp_path, small_library):
    write_planted(CASE, tmp_path / "measured", tmp_path / "sealed")
    answer = tmp_path / "sealed" / "11.answer"
    first, opened = diagnosed(tmp_path)
    assert any(name.endswith("MEASURED.csv") for name in opened)
    assert not [name for name in opened if "sealed" in name or name.endswith(".answer")]
    seal(answer, replace(CASE.answer, kind="none", effects=()))
    answer.rename(tmp_path / "elsewhere")
    assert diagnosed(tmp_path)[0] == first


def test_the_scorer_opens_it_and_the_watch_notices(tmp_path):
    write_planted(CASE, tmp_path / "measured", tmp_path / "sealed")
    write_findings(tmp_path / "findings.json", {"11": ScoredDiagnosis("none")}, "")
    WATCHED[:] = ["watching"]
    (scored,) = read_scored([tmp_path / "findings.json"], [tmp_path / "sealed"])
    opened = WATCHED[1:]
    WATCHED.clear()
    assert scored.answer == CASE.answer
    assert [name for name in opened if name.endswith("11.answer")]
