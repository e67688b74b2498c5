"""Every check is met, and the stored table shows them."""

import re
from pathlib import Path

import pytest

from verification.__main__ import main
from verification.block_checks import block_checks, growth
from verification.land import Problem, fine_land_checks
from verification.tables import MISSED, all_checks, checks_table, every_check

COMMITTED = Path(__file__).parents[2] / "docs" / "measured" / "verification_checks.tsv"

NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e-?\d+)?")
ROUNDING = "\t1e-10\t"
"""Unit of the rows that show rounding errors only."""


def stale_lines(committed: str, printed: str) -> list[str]:
    """Lines of a table whose numbers are off by more than another processor explains: 2 % and 0.03."""
    pairs = zip(committed.splitlines(), printed.splitlines(), strict=True)
    return [
        old
        for old, new in pairs
        if ROUNDING not in old and numbers(old) != pytest.approx(numbers(new), 0.02, 0.03)
    ]


def stored_lines() -> list[str]:
    """Lines of the stored table without the one that says what made it."""
    return COMMITTED.read_text().splitlines()[1:]


def numbers(line: str) -> list[float]:
    return [float(number) for number in NUMBER.findall(line)]


def test_a_stale_number_is_detected():
    row = "V_min\t41.20\t41 ± 2\tmet\tmL\tit\n"
    assert not stale_lines(row, row.replace("41.20", "41.25"))
    assert stale_lines(row, row.replace("41.20", "44.20"))
    assert not stale_lines("drift\t0.04\t0 ± 1\tmet\t1e-10\tit", "drift\t0.39\t0 ± 1\tmet\t1e-10\tit")


@pytest.mark.long
def test_the_stored_table_has_the_current_numbers():
    printed = checks_table().to_csv(sep="\t", index=False)
    assert not stale_lines("\n".join(stored_lines()), printed), "python -m verification store"


@pytest.fixture
def solved(monkeypatch):
    """Benchmark problems with expected results: the test concerns their rows, not their results."""
    monkeypatch.setattr(Problem, "answers", lambda problem, size: dict(problem.expected))


@pytest.mark.long
def test_the_checks_of_the_finest_meshes_are_met():
    assert not [check for check in fine_land_checks() if not check.passed]


@pytest.mark.long
def test_every_check_is_met():
    missed = [check for check in all_checks() if not check.passed]
    assert not missed


@pytest.mark.long
def test_p1_locks_and_mixed_does_not():
    assert growth("p1") > 1.4
    assert growth("mixed") == pytest.approx(1.0, abs=0.03)


@pytest.mark.long
def test_both_norms_of_both_elements_are_checked():
    names = " ".join(check.name for check in block_checks())
    assert all(f"{element}: order in {norm}" in names for element in ("p1", "mixed") for norm in ("L2", "H1"))


@pytest.mark.long
def test_the_command_prints_a_row_per_check_and_no_missed_one(solved, capsys):
    assert main([]) == 0
    printed = capsys.readouterr().out
    assert printed == checks_table().to_csv(sep="\t", index=False)
    assert printed.count("\tmet\t") == len(every_check())


@pytest.mark.long
def test_the_command_fails_if_a_check_is_missed(monkeypatch, capsys):
    monkeypatch.setattr(Problem, "answers", lambda problem, size: dict.fromkeys(problem.expected, 0.0))
    assert main([]) == 1
    assert MISSED in capsys.readouterr().out


@pytest.mark.long
def test_the_stored_table_has_the_same_checks(solved):
    _, *rows = stored_lines()
    assert [row.split("\t")[0] for row in rows] == [check.name for check in every_check()]


def test_every_stored_check_is_met():
    _, *rows = stored_lines()
    assert len(rows) >= 78
    assert all(row.split("\t")[3] == "met" for row in rows)
