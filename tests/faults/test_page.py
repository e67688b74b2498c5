"""The page of faults tells of every kind that is tried, and of none that was not mended."""

from tests.faults.campaign import PAGE, page
from tests.faults.outcome import Outcome


def test_every_row_was_mended():
    rows = [line for line in PAGE.read_text().splitlines() if line.startswith("| ")][1:]
    assert len(rows) >= 15
    assert all(row.endswith("| yes |") for row in rows)


def test_a_fault_that_is_not_mended_is_told():
    outcomes = [Outcome("a kill", "nothing", True), Outcome("a flood", "water", False)]
    told = page({"tables/table1.csv": "", "motion.npz": ""}, outcomes)
    assert "| a kill | nothing | yes |\n| a flood | water | **no** |\n" in told
    assert "`.csv`, `.npz`" in told
    assert "2 results" in told
