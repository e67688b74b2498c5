"""A late activation by itself is not taken for slow relaxation: how long the fibres take is free in every heart."""

import pytest
from tests.diagnosis.hearts import recorded

from heartfit.diagnosis import case as searching
from heartfit.diagnosis import library
from heartfit.diagnosis.case import Case
from heartfit.diagnosis.free import OF_THE_SPHERE
from heartfit.diagnosis.twin import Twin
from heartfit.planting.campaign import Plan

RIVALS = ("DelayedActivation", "SlowRelaxation")


def rivals(twin: Twin) -> dict[str, library.Candidate]:
    return {name: library.candidates(twin)[name] for name in RIVALS}


@pytest.mark.parametrize("scales", [1.0, 2.0])
def test_a_late_activation_is_not_called_slow_relaxation(scales, monkeypatch):
    assert "spread" in {each.name for each in OF_THE_SPHERE}
    monkeypatch.setattr(searching, "candidates", rivals)
    found = Case.searched(recorded(Plan(712, "single", ("DelayedActivation",), scales)))
    assert found.ranking()["DelayedActivation"] > found.ranking()["SlowRelaxation"]
    assert ("SlowRelaxation",) not in found.explanations
