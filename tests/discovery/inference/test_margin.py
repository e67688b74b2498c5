"""Margins of decisions: those of closed-form examples, and that no smaller change of a ln Z changes a verdict."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.discovery.inference.decide import Decision, Evidences, decide
from heartfit.discovery.inference.margin import CLOSE, GRID, Margin, margin

A, B, AB = ("a",), ("b",), ("a", "b")


def evidences(
    a: float, b: float = -9.0, process: float = -9.0, left: float = 0.0, pair: float | None = None
) -> Evidences:
    """The baseline has 0; left: gain of the process on top of the best single effect."""
    pairs = {} if pair is None else {AB: pair}
    best = A if a >= b else B
    return Evidences(0.0, {A: a, B: b}, process, {best: max(a, b) + left} | pairs, pairs)


@pytest.mark.parametrize(
    ("evidence", "expected"),
    [
        (evidences(4.7), Margin(A, False, 0.3, "named")),  # detected from 5
        (evidences(5.2), Margin(("baseline",), False, 0.21, "none")),
        (evidences(8.0, process=6.3), Margin(A, False, 0.3, "named")),  # 2 better than the process
        (evidences(9.0, left=3.9), Margin(A, False, -0.11, "unknown")),  # leaves 4 at most
        (evidences(12.0, 8.9), Margin(B, False, 0.11, "group")),  # within 3
        (evidences(12.0, pair=18.6), Margin(A, False, -0.4, "two")),  # 7 better than one effect
        (evidences(4.4), None),
        (evidences(12.0), None),
        (evidences(12.0, 11.9), None),  # a group whose order changes stays the group
    ],
)
def test_margins_of_single_conditions(evidence: Evidences, expected: Margin | None) -> None:
    nearest = margin(evidence)
    if expected is None:
        assert nearest is None
    else:
        assert nearest is not None
        assert abs(nearest.change) == pytest.approx(abs(expected.change), abs=1.1 * GRID)
        assert nearest.verdict == expected.verdict
        assert nearest.on_top is expected.on_top or expected.explanation == A


def with_change(evidence: Evidences, change: float, rng: np.random.Generator) -> Evidences:
    """The evidences with one ln Z, drawn at random among those of a decision, changed."""
    where = rng.integers(4)
    if where == 0:
        return replace(evidence, baseline=evidence.baseline + change)
    if where == 1:
        return replace(evidence, discrepancy=evidence.discrepancy + change)
    if where == 2:
        single = evidence.single
        return replace(evidence, on_top={**evidence.on_top, single: evidence.on_top[single] + change})
    name = (A, B)[rng.integers(2)]
    singles = {**evidence.singles, name: evidence.singles[name] + change}
    left = evidence.on_top[evidence.single] - evidence.singles[evidence.single]
    others = {effects: value + left for effects, value in singles.items()}
    return replace(evidence, singles=singles, on_top=others | dict(evidence.on_top))


def drawn(rng: np.random.Generator) -> Evidences:
    a, b = rng.uniform(2.0, 14.0, 2)
    pair = float(max(a, b) + rng.uniform(5.0, 9.0)) if rng.random() < 0.5 else None
    return evidences(a, b, float(max(a, b) - rng.uniform(0.0, 4.0)), rng.uniform(2.0, 6.0), pair)


def named(decision: Decision) -> tuple[str, frozenset]:
    return decision.verdict, frozenset(
        [decision.effects, *(decision.alternatives if decision.verdict == "group" else ())]
    )


def test_no_smaller_change_of_one_evidence_changes_what_is_decided() -> None:
    rng, close = np.random.default_rng(46), 0
    for _ in range(80):
        evidence = drawn(rng)
        nearest = margin(evidence)
        close += nearest is not None
        smallest = CLOSE if nearest is None else abs(nearest.change) - GRID
        for change in rng.uniform(-1.0, 1.0, 10) * smallest:
            assert named(decide(with_change(evidence, change, rng))) == named(decide(evidence))
    assert 20 < close < 70
