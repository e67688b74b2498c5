"""Rules for a pair: the same evidences under each candidate, and what counts as a right and as a wrong name."""

from dataclasses import replace
from math import inf

import pytest

from benchmarks.named_pairs import CANDIDATES, HEARTS, SearchedHeart, rates_table
from heartfit.discovery.inference.decide import DEFAULT_RULES, Evidences
from heartfit.study.discovery import SCORING
from heartfit.synthetic.campaign import PlantedPlan

LEAK, DELAY, BOTH = ("Leak",), ("Delay",), ("Leak", "Delay")
TWO = PlantedPlan(1, "two", ("Delay", "Leak"), 3.0)
BEFORE, _, _, BY_2, ELSE_SINGLE, _, _ = CANDIDATES
MARGINS = (-inf, -2.0, 0.0, 2.0, 2.0, 2.0, 10.0)


def heart(process: float, plan: PlantedPlan = TWO, helps: bool = True) -> SearchedHeart:
    """A heart whose pair has 20 and whose best single effect has 12."""
    on_top = {LEAK: 12.5, BOTH: 20.5}
    return SearchedHeart(
        plan,
        Evidences(0.0, {LEAK: 12.0, DELAY: 3.0}, process, on_top, {BOTH: 20.0}),
        {LEAK: True, BOTH: helps},
    )


@pytest.mark.parametrize("process", [9.0, 10.5, 18.5, 21.0, 23.0])
def test_each_candidate_demands_its_margin(process: float) -> None:
    names = [heart(process).names(candidate) for candidate in CANDIDATES.values()]
    assert names == [BOTH if 20.0 - process >= margin else () for margin in MARGINS]


def test_a_single_effect_stands_in_where_it_is_explained_itself() -> None:
    left = replace(heart(9.0).evidences, on_top={LEAK: 12.5, BOTH: 30.0})
    weak = replace(heart(9.0), evidences=left)
    assert [weak.names(CANDIDATES[rule]) for rule in (BY_2, ELSE_SINGLE)] == [(), LEAK]


def test_one_of_two_is_incomplete_but_a_name_of_another_effect_is_wrong() -> None:
    rule = CANDIDATES[BEFORE]
    hidden = {
        "both": TWO,
        "one": PlantedPlan(1, "single", LEAK, 3.0),
        "outside": PlantedPlan(1, "outside", ("CatheterWhip",), 3.0),
        "nothing": PlantedPlan(1, "none"),
    }
    judged = {
        name: (heart(9.0, plan).right(rule), heart(9.0, plan).wrong(rule)) for name, plan in hidden.items()
    }
    assert judged.pop("both") == (True, False)
    assert set(judged.values()) == {(False, True)}
    assert not heart(9.0, helps=False).right(rule), "the other half withdraws it"


def test_the_hearts_are_reserved_and_the_first_candidate_is_the_rule_of_single_effects_alone() -> None:
    seeds = [plan.seed for hearts in HEARTS.values() for plan in hearts.plans()]
    assert len(seeds) == len(set(seeds))
    assert min(seeds) > SCORING
    assert CANDIDATES[BEFORE].singles == CANDIDATES[BY_2].pairs == DEFAULT_RULES


def test_a_kind_without_hearts_has_no_rate() -> None:
    first = rates_table([heart(9.0)]).iloc[0]
    assert first["pairs: right"].startswith("1 of 1 ")
    assert first["sound: named"] == ""
