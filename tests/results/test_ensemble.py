"""An ensemble of runs that differ in rounding: its own runs agree with it, and a real change does not."""

import numpy as np
import pandas as pd
import pytest

from heartfit.results.cells import Tables, find_moves
from heartfit.results.ensemble import Ensemble, leave_one_out

RUNS, CASES, SHARE = 12, 100, 2e-4
"""Runs, rows of a table, and the relative deviation of a quarter of its numbers."""


def run(seed: int, changed: float = 1.0, name: str = "delay") -> Tables:
    """Return the tables of a run: errors of cases, of which a quarter move, and the name of an effect."""
    rng = np.random.default_rng(seed)
    moving = np.arange(CASES) % 4 == 0
    errors = np.linspace(1.0, 20.0, CASES) * (1.0 + SHARE * moving * rng.standard_normal(CASES))
    errors[1] *= changed
    table1 = pd.DataFrame(
        {"case": [f"v{row}" for row in range(CASES)], "V_min": [f"{x:.6g}" for x in errors]}
    )
    discovery = pd.DataFrame({"text": [f"{name}: {2.5 + 0.1 * (seed % 3):.2f} sd"]})
    return {"table1": table1, "discovery": discovery, "meshes": pd.DataFrame({"hash": [f"{seed}ab"]})}


MEMBERS = {str(seed): run(seed) for seed in range(RUNS)}
STORED = run(100)
ENSEMBLE = Ensemble.of(STORED, list(MEMBERS.values()))


def outside(tables: Tables, ensemble: Ensemble = ENSEMBLE) -> list[str]:
    return [str(move) for move in find_moves(STORED, tables) if not ensemble.holds(move)]


def test_each_member_left_out_and_further_runs_agree() -> None:
    assert leave_one_out(STORED, MEMBERS) == {name: [] for name in MEMBERS}
    further = [move for seed in range(200, 230) for move in outside(run(seed)) if "hash" not in move]
    assert further == []


@pytest.mark.parametrize("size", [0.99, 1.01])
def test_a_change_of_one_per_cent_in_one_cell_lies_outside(size: float) -> None:
    (cell,) = (move for move in outside(run(300, size)) if "hash" not in move)
    assert cell.startswith("table1, row 2 (v1), V_min")


def test_other_words_lie_outside_unless_a_member_has_them() -> None:
    moves = [move for move in outside(run(300, name="damping")) if "hash" not in move]
    assert len(moves) == 1
    both = Ensemble.of(STORED, [*MEMBERS.values(), run(50, name="damping"), run(51, name="damping")])
    assert [move for move in outside(run(300, name="damping"), both) if "hash" not in move] == []


def test_another_mesh_lies_outside_whatever_the_members_read() -> None:
    assert [move for move in outside({**STORED, "meshes": pd.DataFrame({"hash": ["cd"]})}) if "hash" in move]


def test_digits_are_those_of_the_deviation() -> None:
    still, moving = (
        ENSEMBLE.digits(("table1", row, "V_min"), STORED["table1"]["V_min"][row]) for row in (1, 4)
    )
    assert still == 6.0
    assert moving == pytest.approx(-np.log10(SHARE), abs=0.4)
    assert ENSEMBLE.digits(("table1", 0, "case"), "patient") == np.inf
    assert ENSEMBLE.digits(("discovery", 0, "text"), "delay: 2.50 sd") < 2.0


def test_another_number_of_rows_is_allowed_only_if_a_member_has_it() -> None:
    shorter = {**STORED, "discovery": STORED["discovery"].head(0)}
    assert outside(shorter)
    again = Ensemble.of(STORED, [*MEMBERS.values(), shorter])
    assert outside(shorter, again) == []
    assert outside(run(300), again) == outside(run(300))


def test_the_stored_form_is_read_back() -> None:
    table = ENSEMBLE.table().astype(str)
    assert Ensemble.from_table(table, ENSEMBLE.members, ENSEMBLE.tested).spreads == ENSEMBLE.spreads
