"""The page of faults lists every kind that is tried, and all are mended."""

from tests.faults.campaign import PAGE, page
from tests.faults.outcome import Outcome
from tests.printed import rows_of


def test_every_row_was_mended():
    rows = [line for line in PAGE.read_text().splitlines() if line.startswith("| ")][1:]
    assert len(rows) >= 15
    assert all(row.endswith("| yes |") for row in rows)


def test_an_unmended_fault_is_reported():
    outcomes = [Outcome("a kill", "nothing", True), Outcome("a flood", "water", False)]
    text = page({"tables/table1.csv": "", "motion.npz": ""}, outcomes)
    rows = rows_of(text)
    assert (rows["a kill"], rows["a flood"]) == (["nothing", "yes"], ["water", "**no**"])
    heading = text.split("|")[0]
    assert [kind for kind in (".csv", ".npz", "2 results") if kind not in heading] == []
