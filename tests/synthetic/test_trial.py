"""Trial of a hidden heart: searched by half of its samples, or by all where another condition judges."""

import pytest

from heartfit.discovery.sphere_model import forward_model as library
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording
from heartfit.roles import registered
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.trial import CONDITION, VOLUME, diagnose_by_data
from tests.discovery.sphere_model.hearts import recorded

pytestmark = pytest.mark.usefixtures("coarse_search")
OFFSET = PlantedPlan(11, "single", ("CatheterOffset",), 2.5)


@pytest.fixture(autouse=True)
def searched(monkeypatch):
    """The recordings that were searched; instruments cost no simulation."""
    few = {name: registered()[name] for name in ("CatheterOffset", "ImageShrinkage")}
    monkeypatch.setattr(library, "registered", lambda: few)
    recordings, search = [], SearchedRecording.search
    monkeypatch.setattr(
        SearchedRecording,
        "search",
        lambda recording, *arguments: recordings.append(recording) or search(recording, *arguments),
    )
    return recordings


@pytest.mark.long
def test_less_and_more_data_are_searched_where_there_are_more(searched):
    diagnosis = diagnose_by_data(recorded(OFFSET), {"legs_raised": recorded(OFFSET, "legs_raised")})
    curves = [len(recording.curves) for recording in searched]
    assert sorted(curves) == [1, 2, 2], "a condition is never searched"
    whole = recorded(OFFSET).curves["lv_volume"].times.size
    sizes = sorted(recording.curves["lv_volume"].times.size for recording in searched)
    assert sizes == [(whole + 1) // 2, (whole + 1) // 2, whole], (
        "another condition judges, and all samples choose"
    )
    assert set(diagnosis.other) == {VOLUME, CONDITION}
    assert diagnosis.other[VOLUME].verdict == "insufficient"
    assert diagnosis.other[CONDITION].names == {"CatheterOffset"}
    assert diagnosis.other[CONDITION].ranking != diagnosis.ranking
    assert diagnosis.other[CONDITION].gain != diagnosis.gain
