"""Each branch of the verdict, on evidences set by hand; the baseline has 0."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from heartfit.discovery.inference.decide import (
    CENTRED_RULES,
    CHANGE_RULES,
    DEFAULT_RULES,
    STRICT_RULES,
    Decision,
    Effects,
    Evidences,
    Rules,
    decide,
    is_detected,
    leading_effects,
)

A, B, C, AB = ("a",), ("b",), ("c",), ("a", "b")


def evidences(
    a: float,
    b: float = 0.0,
    discrepancy: float = -5.0,
    on_top: float = 0.0,
    pair: float | None = None,
    left: float = 0.0,
) -> Evidences:
    """on_top and left: gains of the GP on top of the best single effect and of the pair."""
    pairs = {} if pair is None else {AB: pair}
    best = A if a >= b else B
    above = {best: max(a, b) + on_top} | {name: value + left for name, value in pairs.items()}
    return Evidences(0.0, {A: a, B: b, C: -1.0}, discrepancy, above, pairs)


@pytest.mark.parametrize(
    ("evidence", "expected"),
    [
        (evidences(4.9), Decision("none")),
        (evidences(5.0), Decision("named", A)),
        (evidences(1.0, discrepancy=5.0), Decision("unknown")),
        (evidences(8.0, discrepancy=6.5), Decision("unknown")),
        (evidences(8.0, discrepancy=6.0), Decision("named", A)),
        (evidences(9.0, on_top=4.1), Decision("unknown")),
        (evidences(9.0, on_top=4.0), Decision("named", A)),
        (evidences(100.0, discrepancy=90.0, on_top=35.0), Decision("named", A)),
        (evidences(100.0, discrepancy=90.0, on_top=36.0), Decision("unknown")),
        (evidences(100.0, discrepancy=90.1, on_top=35.0), Decision("unknown")),
        (evidences(12.0, 9.5), Decision("group", A, (B,))),
        (evidences(9.5, 12.0), Decision("group", B, (A,))),
        (evidences(12.0, 9.0), Decision("named", A)),
        (evidences(12.0, pair=18.9), Decision("named", A)),
        (evidences(12.0, pair=19.0), Decision("two", AB)),
        (evidences(12.0, discrepancy=17.0, pair=19.0), Decision("two", AB)),
        (evidences(12.0, discrepancy=17.1, pair=19.0), Decision("unknown")),
        (evidences(12.0, discrepancy=17.0, pair=19.0, left=4.0), Decision("two", AB)),
        (evidences(12.0, discrepancy=17.0, pair=19.0, left=4.1), Decision("unknown")),
        (evidences(12.0, discrepancy=90.0, pair=100.0, left=35.0), Decision("two", AB)),
        (evidences(12.0, discrepancy=90.1, pair=100.0, left=35.0), Decision("unknown")),
    ],
)
def test_decision_rules(evidence, expected) -> None:
    assert decide(evidence) == expected


@pytest.mark.parametrize(
    ("rules", "threshold"),
    [(DEFAULT_RULES, 5.0), (CENTRED_RULES, 7.0), (STRICT_RULES, 10.0)],
    ids=["other-integrator", "centred-on-a-3-D-beat", "other-structure"],
)
def test_the_farther_the_model_from_the_source_of_the_data_the_stricter_the_threshold(
    rules: Rules, threshold: float
) -> None:
    assert decide(evidences(threshold - 0.1), rules) == Decision("none")
    assert decide(evidences(threshold), rules) == Decision("named", A)


SEARCH_RULES = (DEFAULT_RULES, CENTRED_RULES, STRICT_RULES, CHANGE_RULES)
NAMES = ("a", "b", "c", "d")
PAIRS = tuple((one, other) for one in NAMES for other in NAMES if one < other)
Search = tuple[Evidences, Rules]


@some.composite
def searches(draw: some.DrawFn) -> Search:
    """Evidences of a search and its rules: pairs only where anything is detected, at least -3 left beside the best."""
    rng, rules = (
        np.random.default_rng(draw(some.integers(0, 2**32 - 1))),
        draw(some.sampled_from(SEARCH_RULES)),
    )
    singles = {(name,): float(rng.normal(4.0, 8.0)) for name in NAMES}
    fitted = Evidences(0.0, singles, float(rng.normal(6.0, 8.0)), {}, {})
    best = max(singles.values())
    pairs = {pair: best + float(rng.normal(6.0, 6.0)) for pair in PAIRS} if is_detected(fitted, rules) else {}
    fitted = replace(fitted, pairs=pairs)
    explained = [effects for effects in (fitted.single, fitted.pair) if effects]
    left = {effects: fitted.log_evidence(effects) + float(rng.uniform(-3.0, 10.0)) for effects in explained}
    return replace(fitted, on_top=left), rules


def is_named(evidences: Evidences, rules: Rules) -> bool:
    return decide(evidences, rules).verdict in ("named", "group", "two")


@given(searches())
def test_no_explanation_is_named_that_is_no_better_than_the_process(search: Search) -> None:
    evidences, rules = search
    decision = decide(evidences, rules)
    if is_named(evidences, rules):
        assert evidences.log_evidence(decision.effects) - evidences.discrepancy >= rules.over_discrepancy


@given(searches())
def test_a_pair_is_named_where_one_effect_of_the_same_evidence_is(search: Search) -> None:
    evidences, rules = search
    leading = leading_effects(evidences, rules)
    best, left = evidences.log_evidence(leading), evidences.on_top[leading]
    alone = Evidences(0.0, {("one",): best}, evidences.discrepancy, {("one",): left}, {})
    if is_detected(evidences, rules):
        assert is_named(evidences, rules) == is_named(alone, rules)


@given(searches(), some.floats(0.0, 30.0))
def test_more_evidence_for_the_process_gives_no_name(search: Search, more: float) -> None:
    evidences, rules = search
    alone = replace(evidences, discrepancy=evidences.discrepancy + more)
    beside = {effects: value + more for effects, value in evidences.on_top.items()}
    for other in (alone, replace(evidences, on_top=beside)):
        assert is_named(evidences, rules) or not is_named(other, rules)


@given(searches(), some.permutations(NAMES))
def test_the_order_of_names_and_the_unit_of_the_data_decide_nothing(search: Search, order: list[str]) -> None:
    """Another unit of the data adds the same to each ln evidence."""
    evidences, rules = search
    new = dict(zip(NAMES, order, strict=True))

    def renamed(effects: Effects) -> Effects:
        return tuple(new[name] for name in effects)

    def rescaled(table: Mapping[Effects, float]) -> dict[Effects, float]:
        return {renamed(effects): value + 64.0 for effects, value in table.items()}

    singles, on_top, pairs = map(rescaled, (evidences.singles, evidences.on_top, evidences.pairs))
    other = decide(Evidences(64.0, singles, evidences.discrepancy + 64.0, on_top, pairs), rules)
    before = decide(evidences, rules)
    assert (other.verdict, other.effects) == (before.verdict, renamed(before.effects))
