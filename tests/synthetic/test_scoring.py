"""The scorer counts correctly for every diagnoser."""

from dataclasses import replace
from math import comb

import pytest

from heartfit.discovery.sphere_model.cause import Cause
from heartfit.observation.noise_model import Share
from heartfit.synthetic.campaign import Effect
from heartfit.synthetic.case import Answer
from heartfit.synthetic.scoring import (
    COMPARED_RATES,
    MISSPECIFIED_RATES,
    RATES,
    DetectableSizes,
    Scored,
    binomial_p_value,
    of_population,
)
from heartfit.synthetic.trial import ScoredDiagnosis


def answer(kind, *names, scales=2.0):
    effects = tuple(Effect(name, 2.0, 1.0, "m^2", scales) for name in names)
    return Answer(0, kind, effects, {}, {}, 0.02)


def diagnosis(verdict, *names):
    return ScoredDiagnosis(verdict, tuple(Cause(name, 9.0, 1.8, "m^2", (1.5, 2.5)) for name in names))


def case(kind, planted, verdict, *names, scales=2.0):
    return Scored(answer(kind, *planted, scales=scales), diagnosis(verdict, *names))


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
    "nulls that were given a name": (1, 4),
    "singles detected at 2 scales": (4, 5),
    "singles detected at more": (1, 1),
    "singles named right, of the named": (1, 3),
    "named right, of all that were named": (2, 9),
    "singles in their group, of the groups": (1, 2),
    "outsiders detected": (2, 3),
    "outsiders called unknown, of the detected": (1, 2),
    "pairs with both right": (1, 4),
    "pairs with a wrong pair": (1, 4),
    "pairs with one name, and right": (1, 4),
}


def test_every_rate_counts_its_cases():
    shares = {rate.name: rate.share_of(CASES) for rate in RATES}
    counts = {
        name: (round(share.covered * share.sequences), share.sequences) for name, share in shares.items()
    }
    assert counts == COUNTS


def test_a_rate_without_cases_is_undefined():
    assert {rate.share_of([]) for rate in (*RATES, *MISSPECIFIED_RATES)} == {None}


def misspecified(scored):
    """The same case in the other population."""
    return replace(scored, answer=replace(scored.answer, population="misspecified"))


def counts_of(rates, cases):
    shares = {rate.name: rate.share_of(cases) for rate in rates}
    return {
        name: share and (round(share.covered * share.sequences), share.sequences)
        for name, share in shares.items()
    }


def test_misspecified_cases_count_in_no_rate_of_the_others_and_the_others_in_none_of_theirs():
    others = [misspecified(case) for case in CASES[:8]]
    assert counts_of(RATES, [*CASES, *others, *others]) == COUNTS
    assert counts_of(RATES, others) == dict.fromkeys(COUNTS)
    assert set(counts_of(MISSPECIFIED_RATES, CASES).values()) == {None}
    sizes = DetectableSizes({("Leak", 1.0): 1.5, ("Scar", 1.0): 1.5})
    assert counts_of(sizes.rates(), [*CASES, *others]) == counts_of(sizes.rates(), CASES)
    assert of_population([*CASES, *others], "misspecified") == others


def test_the_rates_of_misspecified_cases_are_those_of_the_others_with_the_targets():
    small = case("single", ("Leak",), "named", "Leak", scales=1.0)
    others = [misspecified(case) for case in [*CASES, small, small]]
    expected = {
        "false alarms of nulls": (2, 4),
        "singles from 2 scales on, detected": (5, 6),
        "singles from 2 scales on, named right, of the named": (1, 3),
        "amplitude in its interval, of those named right": (1, 1),
    }
    assert counts_of(COMPARED_RATES, [*CASES, small]) == expected
    assert counts_of(MISSPECIFIED_RATES, others) == {
        f"misspecified: {name}": count for name, count in expected.items()
    }
    targets = {
        rate.name: (rate.target, rate.at_most) for rate in MISSPECIFIED_RATES if rate.target is not None
    }
    assert targets == {
        "misspecified: false alarms of nulls": (0.05, True),
        "misspecified: singles from 2 scales on, named right, of the named": (0.90, False),
    }


def test_an_interval_that_misses_the_planted_amplitude_is_not_counted_as_one_that_holds_it():
    beyond = Scored(
        Answer(0, "single", (Effect("Leak", 3.0, 1.0, "m^2", 2.0),), {}, {}, 0.02), diagnosis("named", "Leak")
    )
    coverage = COMPARED_RATES[-1].share_of([CASES[4], beyond])
    assert (coverage.covered, coverage.sequences) == (0.5, 2)


def test_targets_are_met_or_missed_by_the_share_itself():
    targets_met = {
        rate.name: rate.meets_target(rate.share_of(CASES)) for rate in RATES if rate.target is not None
    }
    assert targets_met == {
        "false alarms of nulls": False,
        "singles detected at 2 scales": True,
        "singles named right, of the named": False,
        "outsiders called unknown, of the detected": False,
        "pairs with a wrong pair": False,
    }


@pytest.mark.parametrize(
    ("count", "at_most"), [(0, True), (3, True), (16, True), (0, False), (9, False), (16, False)]
)
def test_the_p_value_is_the_tail_of_the_binomial(count, at_most):
    claim, n = 0.3, 16
    worse = range(count, n + 1) if at_most else range(count + 1)
    tail = sum(comb(n, k) * claim**k * (1.0 - claim) ** (n - k) for k in worse)
    assert binomial_p_value(Share.from_count(count, n), claim, at_most) == pytest.approx(tail)


def test_amplitudes_are_compared_from_where_the_effect_is_off():
    scored = CASES[4]
    (effect,) = scored.answer.effects
    assert scored.ratio(effect) == pytest.approx(0.8)
    assert scored.covered(effect)
    assert not scored.covered(Effect("Leak", 2.6, 1.0, "m^2", 2.0))
    assert not scored.covered(Effect("Leak", 1.4, 1.0, "m^2", 2.0))


def test_the_conclusion_is_the_named_effect_or_the_verdict():
    assert [case.conclusion for case in CASES[:5]] == ["none", "insufficient", "unknown", "Leak", "Leak"]
    assert CASES[9].conclusion == "two"


@pytest.mark.parametrize(
    ("amplitude", "scales", "detectable"),
    [(3.0, 2.0, True), (-1.0, 2.0, False), (-1.0, 4.0, True), (3.0, 1.0, False)],
)
def test_a_size_is_detectable_from_the_limit_of_its_sign_on(amplitude, scales, detectable):
    """Detectable sizes of 1.5 scales above the off value of 1 and of 3 scales below it."""
    sizes = DetectableSizes({("Delay", 1.0): 1.5, ("Delay", -1.0): 3.0})
    effect = Effect("Delay", amplitude, 1.0, "s", scales)
    planted = Scored(Answer(0, "single", (effect,), {}, {}, 0.02), diagnosis("none"))
    assert sizes.is_detectable(planted) is detectable
    assert not sizes.is_detectable(case("none", (), "none"))
