"""A heart on trial: one search says what volume and pressure show, and what another condition leaves of it."""

from dataclasses import replace

import pytest
from tests.diagnosis.hearts import recorded

from heartfit.diagnosis import library
from heartfit.mechanism import registered
from heartfit.planting.campaign import Plan
from heartfit.planting.trial import CONDITION, VOLUME, found, found_by_data

OFFSET = Plan(11, "single", ("CatheterOffset",), 2.5)


@pytest.fixture(autouse=True)
def small_library(monkeypatch):
    """Instruments cost no simulation."""
    few = {name: registered()[name] for name in ("CatheterOffset", "ImageShrinkage")}
    monkeypatch.setattr(library, "registered", lambda: few)


def test_less_and_more_data_are_searched_where_there_are_more():
    rest = recorded(OFFSET)
    alone = found_by_data(rest, {})
    said = found_by_data(rest, {"legs_raised": recorded(OFFSET, "legs_raised")})
    assert alone == replace(found(rest), seconds=alone.seconds)
    assert replace(said, seconds=0.0, other={}) == replace(alone, seconds=0.0)
    assert set(said.other) == {VOLUME, CONDITION}
    assert said.other[VOLUME].verdict == "insufficient"
    assert said.other[CONDITION].names == said.names == {"CatheterOffset"}
    assert said.other[CONDITION].gain != said.gain
