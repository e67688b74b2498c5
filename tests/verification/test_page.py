"""Every row of the page is met, and the page shows them."""

from pathlib import Path

import pytest

from heartfit import cli
from heartfit.verification.block_checks import block_checks, growth
from heartfit.verification.land import Problem
from heartfit.verification.land_checks import fine_land_checks
from heartfit.verification.page import MISSED, all_checks, page_checks, verification_page

COMMITTED = Path(__file__).parents[2] / "docs" / "verification.md"


@pytest.fixture
def solved(monkeypatch):
    """The benchmark's problems answered as expected: what is written of them is at stake here, not their answers."""
    monkeypatch.setattr(Problem, "answers", lambda problem, size: dict(problem.expected))


@pytest.mark.long
def test_the_checks_of_the_finest_meshes_are_met():
    assert not [check for check in fine_land_checks() if not check.passed]


@pytest.mark.long
def test_every_check_is_met():
    missed = [check for check in all_checks() if not check.passed]
    assert not missed


def test_p1_locks_and_mixed_does_not():
    assert growth("p1") > 1.4
    assert growth("mixed") == pytest.approx(1.0, abs=0.03)


def test_both_norms_of_both_elements_are_checked():
    names = " ".join(check.name for check in block_checks())
    assert all(f"{element}: order in {norm}" in names for element in ("p1", "mixed") for norm in ("L2", "H1"))


def test_the_page_has_a_row_per_check_and_no_missed_one(solved):
    page = verification_page()
    assert page.count("| met |") == len(page_checks())
    assert MISSED not in page


def test_the_command_prints_the_page(solved, capsys):
    assert cli.main(["verification"]) == 0
    assert capsys.readouterr().out == verification_page()


def test_the_command_fails_if_a_check_is_missed(monkeypatch, capsys):
    monkeypatch.setattr(Problem, "answers", lambda problem, size: dict.fromkeys(problem.expected, 0.0))
    assert cli.main(["verification"]) == 1
    assert MISSED in capsys.readouterr().out


def test_the_committed_page_has_the_same_checks(solved):
    rows = [
        line.split("|")[1].strip()
        for line in COMMITTED.read_text().splitlines()
        if "± " in line or "| ≥ " in line
    ]
    assert rows == [check.name for check in page_checks()]
    assert MISSED not in COMMITTED.read_text()
