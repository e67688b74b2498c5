"""Each branch of the verdict, on evidences set by hand; the baseline has 0."""

import pytest

from heartfit.discovery.inference.decide import (
    CENTRED_RULES,
    DEFAULT_RULES,
    STRICT_RULES,
    Decision,
    Evidences,
    Rules,
    decide,
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
