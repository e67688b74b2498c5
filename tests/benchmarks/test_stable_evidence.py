"""The summary of moved evidence counts hearts by their largest moves, verdicts and margins."""

import pandas as pd

from benchmarks.stable_evidence import plan_of, summary

MOVES = ("moves by 1e-10", "moves by 1e-6", "best moves by 1e-10", "best moves by 1e-6")
ROWS = (
    ("", (0.1, 0.6, 0.1, 0.2), "none; none; none", "; ; "),
    ("A", (0.1, 0.2, 0.1, 0.2), "none; named A; none", "0.2; ; "),
    ("B", (0.7, 0.2, 0.6, 0.2), "none; none; unknown", "; ; "),
)


def test_moves_and_verdicts_are_counted_by_hidden_and_sound_hearts() -> None:
    table = pd.DataFrame(
        [
            {"hidden": hidden, **dict(zip(MOVES, map(str, moves), strict=True)), "verdicts": words, "margins": margins}
            for hidden, moves, words, margins in ROWS
        ]
    )  # fmt: skip
    counts = summary(table).set_index("hearts").T
    assert counts["all"].to_dict() == {
        "number": "3",
        "leading three kept, 1e-10": "2",
        "leading three kept, 1e-6": "2",
        "leading three kept, both": "1",
        "the best kept, 1e-10": "2",
        "the best kept, 1e-6": "3",
        "other verdicts": "2",
        "of these close": "1",
        "close decisions": "1",
    }
    assert (counts["sound"]["number"], counts["hidden"]["number"]) == ("1", "2")


def test_half_of_the_hearts_are_hidden_ones_and_half_of_each_misspecified() -> None:
    plans = [plan_of(number) for number in range(40)]
    kinds = [(plan.kind, plan.population) for plan in plans]
    assert {kind: kinds.count(kind) for kind in set(kinds)} == {
        (kind, population): 10
        for kind in ("none", "single")
        for population in ("as searched", "misspecified")
    }
