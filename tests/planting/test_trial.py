"""A heart on trial: one search says what volume and pressure show, and what another condition leaves of it."""

import pytest
from tests.diagnosis.hearts import recorded

from heartfit.diagnosis import library
from heartfit.diagnosis.case import Case
from heartfit.mechanism import registered
from heartfit.planting.campaign import Plan
from heartfit.planting.trial import CONDITION, VOLUME, found_by_data

OFFSET = Plan(11, "single", ("CatheterOffset",), 2.5)


@pytest.fixture(autouse=True)
def searched(monkeypatch):
    """The recordings that were searched; instruments cost no simulation."""
    few = {name: registered()[name] for name in ("CatheterOffset", "ImageShrinkage")}
    monkeypatch.setattr(library, "registered", lambda: few)
    recordings, search = [], Case.searched
    monkeypatch.setattr(
        Case, "searched", lambda each, *given: recordings.append(each) or search(each, *given)
    )
    return recordings


def test_less_and_more_data_are_searched_where_there_are_more(searched):
    said = found_by_data(recorded(OFFSET), {"legs_raised": recorded(OFFSET, "legs_raised")})
    assert [len(each.curves) for each in searched] == [2, 1], "a condition is never searched"
    assert set(said.other) == {VOLUME, CONDITION}
    assert said.other[VOLUME].verdict == "insufficient"
    assert said.other[CONDITION].names == {"CatheterOffset"}
    assert said.other[CONDITION].ranking == said.ranking
    assert said.other[CONDITION].gain != said.gain
