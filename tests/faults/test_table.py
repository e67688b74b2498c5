"""The table of faults lists every kind that is tried, and all are mended."""

from tests.faults.campaign import STORED, table
from tests.faults.outcome import Outcome


def test_every_stored_fault_was_mended():
    _, _, *rows = STORED.read_text().splitlines()
    assert len(rows) >= 15
    assert all(row.endswith("\tyes") for row in rows)


def test_an_unmended_fault_is_reported():
    shown = table([Outcome("a kill", "nothing", True), Outcome("a flood", "water", False)])
    assert shown.to_numpy().tolist() == [["a kill", "nothing", "yes"], ["a flood", "water", "**no**"]]
