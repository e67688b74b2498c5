"""A late activation is not taken for slow relaxation: how long the fibres take is free in every heart."""

from tests.diagnosis.hearts import recorded

from heartfit.diagnosis import case as searching
from heartfit.diagnosis import library
from heartfit.diagnosis.case import Case
from heartfit.diagnosis.free import OF_THE_SPHERE
from heartfit.diagnosis.twin import Twin
from heartfit.planting.campaign import Plan


def rival(twin: Twin) -> dict[str, library.Candidate]:
    return {"SlowRelaxation": library.candidates(twin)["SlowRelaxation"]}


def test_a_late_activation_is_not_called_slow_relaxation_even_where_nothing_else_is_known(monkeypatch):
    assert "spread" in {each.name for each in OF_THE_SPHERE}
    monkeypatch.setattr(searching, "candidates", rival)
    found = Case.searched(recorded(Plan(712, "single", ("DelayedActivation",), 2.0)))
    assert found.ranking()["SlowRelaxation"] < found.rules.detected
    assert found.explanations == ()
