"""The scorer counts what it is said to count, whoever the diagnoser is."""

import pytest

from heartfit.planting.case import Answer
from heartfit.planting.effects import Effect
from heartfit.planting.scoring import Finding, Named, Scored, rates


def answer(kind, *names, scales=2.0):
    effects = tuple(Effect(name, 2.0, "m^2", scales) for name in names)
    return Answer(0, kind, effects, {}, {}, 0.02)


def found(verdict, *names):
    return Finding(verdict, tuple(Named(name, 9.0, 1.8, (1.5, 2.5)) for name in names))


def case(kind, planted, verdict, *said, scales=2.0):
    return Scored(answer(kind, *planted, scales=scales), found(verdict, *said))


CASES = [
    case("none", (), "none"),
    case("none", (), "insufficient"),
    case("none", (), "unknown"),
    case("none", (), "named", "Leak"),
    case("single", ("Leak",), "named", "Leak"),
    case("single", ("Leak",), "named", "Scar"),
    case("single", ("Leak",), "none"),
    case("single", ("Scar",), "group", "Leak", "Scar"),
    case("single", ("Scar",), "group", "Leak", "Kick"),
    case("single", ("Scar",), "two", "Scar", "Leak", scales=3.0),
    case("outside", ("Whip",), "unknown"),
    case("outside", ("Whip",), "named", "Leak"),
    case("outside", ("Whip",), "none"),
    case("two", ("Leak", "Scar"), "two", "Scar", "Leak"),
    case("two", ("Leak", "Scar"), "two", "Scar", "Kick"),
    case("two", ("Leak", "Scar"), "named", "Scar"),
    case("two", ("Leak", "Scar"), "named", "Kick"),
]
COUNTS = {
    "false alarms of nulls": (2, 4),
    "names of nulls": (1, 4),
    "detected at 2 scales": (4, 5),
    "detected at 3 scales": (1, 1),
    "named right, of the names given to singles": (1, 3),
    "named right, of the names given to all": (2, 9),
    "groups that hold the cause, of the groups": (1, 2),
    "outsiders detected": (2, 3),
    "unknown, of the outsiders detected": (1, 2),
    "pairs: both right": (1, 4),
    "pairs: a wrong pair": (1, 4),
    "pairs: one, and right": (1, 4),
}


def test_every_rate_counts_its_cases():
    seen = {
        rate.name: (round(rate.share.covered * rate.share.sequences), rate.share.sequences)
        for rate in rates(CASES)
    }
    assert seen == COUNTS


def test_a_rate_of_no_case_says_nothing():
    assert {rate.met for rate in rates([])} == {None}


def test_targets_are_met_or_missed_by_the_share_itself():
    met = {rate.name: rate.met for rate in rates(CASES) if rate.target is not None}
    assert met == {
        "false alarms of nulls": False,
        "detected at 2 scales": True,
        "named right, of the names given to singles": False,
        "unknown, of the outsiders detected": False,
        "pairs: a wrong pair": False,
    }


def test_amplitudes_are_compared_from_where_the_effect_is_off():
    scored = CASES[4]
    (effect,) = scored.answer.effects
    assert scored.ratio(effect, off=1.0) == pytest.approx(0.8)
    assert scored.covered(effect)
    assert not scored.covered(Effect("Leak", 2.6, "m^2", 2.0))


def test_what_is_said_is_the_name_where_one_is_given():
    assert [each.said for each in CASES[:5]] == ["none", "insufficient", "unknown", "Leak", "Leak"]
    assert CASES[9].said == "two"
