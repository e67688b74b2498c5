"""Every cell of a table is held: on the same machine to the digit, on another one within what rounding moves."""

from math import inf

import pandas as pd
import pytest

from heartfit.results.cells import find_moves
from heartfit.results.drift import StoredTables, drift_table
from heartfit.results.ensemble import Ensemble
from heartfit.results.stages import in_order

STORED = {
    "table1": pd.DataFrame(
        {"case": ["v1", "mean of 7"], "V_min (%)": ["0.4", "1.73412"], "failed points": ["0 of 9", ""]}
    ),
    "discovery": pd.DataFrame({"quantity": ["misfit"], "text": ["3 kPa too high in ejection: 3.0 sd"]}),
}


def changed(table: str, row: int, column: str, text: str) -> dict[str, pd.DataFrame]:
    """Return the tables with one other cell."""
    tables = {name: frame.copy() for name, frame in STORED.items()}
    tables[table].loc[row, column] = text
    return tables


HERE, THERE = {"compiled for": "this"}, {"compiled for": "another"}


STILL = Ensemble.of(STORED, [STORED] * 12)
"""Ensemble of runs in which nothing moved."""


def drifted(
    tables: dict[str, pd.DataFrame], same_machine: bool = False, ensemble: Ensemble = STILL
) -> list[str]:
    stored = StoredTables(STORED, HERE, ensemble)
    return [str(move) for move in stored.compared(tables, HERE if same_machine else THERE).drifted]


def test_equal_tables_do_not_move() -> None:
    assert find_moves(STORED, STORED) == []
    assert StoredTables(STORED, HERE).compared(STORED, HERE).cells == 8


@pytest.mark.parametrize("size", [0.003, 0.01, 0.25, 1.0])
def test_any_number_that_moves_by_a_share_of_itself_drifts_on_any_machine(size: float) -> None:
    for text in ("0.4", "1.73412"):
        row = [*STORED["table1"]["V_min (%)"]].index(text)
        # one decimal more than the stored text, whose last digit is the limit of what can be seen
        tables = changed("table1", row, "V_min (%)", f"{float(text) * (1.0 + size):.6g}")
        assert drifted(tables, same_machine=True)
    assert drifted(changed("table1", 1, "V_min (%)", f"{1.73412 * (1.0 + size):.6g}"))


def test_the_last_digit_counts_on_the_same_machine_only() -> None:
    tables = changed("table1", 1, "V_min (%)", "1.73413")
    assert drifted(tables, same_machine=True) == [
        "table1, row 2 (mean of 7), V_min (%): 1.73412 before, 1.73413 now"
    ]
    assert drifted(tables) == []
    assert drifted(changed("table1", 1, "V_min (%)", "1.7373"))


def test_numbers_in_words_are_held_and_words_as_such() -> None:
    cell = ("discovery", 0, "text")
    assert drifted(changed(*cell, "3 kPa too high in ejection: 3.2 sd"))
    assert drifted(changed(*cell, "3 kPa too high in ejection: 3.1 sd")) == [], "its last printed digit"
    assert drifted(changed(*cell, "3 kPa too low in ejection: 3.0 sd"))
    assert find_moves(STORED, changed(*cell, "3 kPa too low in ejection: 3.0 sd"))[0].change == inf
    assert drifted(changed("table1", 0, "failed points", "2 of 9"))


def test_a_missing_number_table_or_row_drifts() -> None:
    assert drifted(changed("table1", 0, "V_min (%)", ""))
    assert drifted({"table1": STORED["table1"]})
    assert drifted({**STORED, "table2": STORED["table1"]}) == [], (
        "a further table, made on request, is not held"
    )
    shorter = {**STORED, "table1": STORED["table1"].head(1)}
    assert drifted(shorter) == [
        "table1: 2 rows of case, V_min (%), failed points before, 1 rows of case, V_min (%), failed points now"
    ]


@pytest.mark.parametrize(
    ("text", "machine", "expected"),
    [
        ("1.73412", HERE, "agree with the stored ones: each of 8 cells is the same"),
        ("1.73413", THERE, "agree with the stored ones: 1 of 8 cells moved"),
        (
            "1.8",
            THERE,
            "1 of 8 cells lie outside the stored tables, on another processor or software; the first in the order",
        ),
        (
            "1.73413",
            HERE,
            "1 of 8 cells lie outside the stored tables, on the processor and software of the stored ones",
        ),
    ],
)
def test_one_line_says_whether_the_tables_agree(text: str, machine: dict[str, str], expected: str) -> None:
    drift = StoredTables(STORED, HERE, STILL).compared(changed("table1", 1, "V_min (%)", text), machine)
    line = drift.line("drift.csv")
    assert expected in line
    assert "\n" not in line


def test_a_mesh_that_differs_is_named_before_the_numbers_that_follow_from_it() -> None:
    meshes = pd.DataFrame({"mesh": ["template coarse"], "nodes": ["607"], "hash": ["6017b703fd248010"]})
    stored = {**STORED, "meshes": meshes}
    other = meshes.assign(nodes="627", hash="46524a818edc0000")
    drift = StoredTables(stored, HERE).compared(
        {**changed("discovery", 0, "text", "no"), "meshes": other}, HERE
    )
    assert [move.cell[0] for move in drift.drifted] == ["meshes", "meshes", "discovery"]
    first = "the first in the order of the study: meshes, row 1 (template coarse, 6017b703fd248010), nodes: 607 before"
    assert first in drift.line("drift.csv")


def test_tables_are_in_the_order_in_which_a_study_makes_them() -> None:
    tables = [
        "meshes",
        "patient1_cine_volume",
        "prior",
        "sensitivity_physical",
        "numbers",
        "table1",
        "discovery",
    ]
    assert in_order(sorted(tables)) == tables


def test_a_study_without_some_cases_is_not_compared() -> None:
    drift = StoredTables(STORED, HERE).compared({}, HERE)
    reason = "patient1 left out"
    assert drift_table(drift, reason).to_dict("list") == {"not compared": [reason]}
    assert drift.line("drift.csv", reason) == f"The tables are not compared with the stored ones: {reason}"
    assert len(drift_table(drift)) == len(STORED)


def test_a_processor_of_which_nothing_is_known_is_not_judged() -> None:
    tables = changed("table1", 1, "V_min (%)", "1.8")
    unknown = StoredTables(STORED, HERE).compared(tables, THERE)
    known = StoredTables(STORED, HERE, STILL).compared(tables, THERE)
    here = StoredTables(STORED, HERE).compared(tables, HERE)
    assert [drift.judged for drift in (unknown, known, here)] == [False, True, True]
    assert "of which it is not known what it moves" in unknown.line("drift.csv")
