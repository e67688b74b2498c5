"""Each branch of the verdict, on evidences set by hand; the baseline has 0."""

import pytest

from heartfit.discovery.inference.decide import STRICT_RULES, Decision, Evidences, decide

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
        (evidences(12.0, pair=19.0, left=4.0), Decision("unknown")),
        (evidences(12.0, discrepancy=30.0, on_top=30.0, pair=50.0), Decision("two", AB)),
    ],
)
def test_decision_rules(evidence, expected) -> None:
    assert decide(evidence) == expected


def test_a_model_of_another_structure_needs_stricter_rules() -> None:
    assert decide(evidences(9.9), STRICT_RULES) == Decision("none")
    assert decide(evidences(10.0), STRICT_RULES) == Decision("named", A)
