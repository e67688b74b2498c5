"""A late activation is not named slow relaxation: the spread of activation is free in every heart."""

import pytest

from heartfit.discovery.sphere_model import forward_model as library
from heartfit.discovery.sphere_model import searched_recording as searching
from heartfit.discovery.sphere_model.forward_model import SphereForwardModel
from heartfit.discovery.sphere_model.free_parameters import SPHERE_PARAMETERS
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording
from heartfit.synthetic.campaign import PlantedPlan
from tests.discovery.sphere_model.hearts import recorded


def competing_candidates(model: SphereForwardModel) -> dict[str, library.Candidate]:
    return {"SlowRelaxation": library.candidates(model)["SlowRelaxation"]}


@pytest.mark.usefixtures("coarse_search")
def test_a_late_activation_is_not_named_slow_relaxation(monkeypatch):
    assert "spread" in {parameter.name for parameter in SPHERE_PARAMETERS}
    monkeypatch.setattr(searching, "candidates", competing_candidates)
    result = SearchedRecording.search(recorded(PlantedPlan(712, "single", ("DelayedActivation",), 2.0)))
    assert result.ranking()["SlowRelaxation"] < result.rules.detected
    assert result.explanations == ()
