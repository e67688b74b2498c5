"""Numbers in the sentences of pages that are written by hand are those of stored results."""

import csv

import pytest

from tests.documentation.blocks import ROOT


def rows_of(stem):
    """Rows of a stored table by the cells of its first columns, as numbers of hearts by outcome."""
    lines = (ROOT / "docs" / "measured" / f"{stem}.tsv").read_text(encoding="utf-8").splitlines()
    rows = list(csv.DictReader(lines[1:], delimiter="\t"))
    outcomes = ("number", "right", "unknown", "nothing", "wrong")
    return {
        tuple(cell for column, cell in row.items() if column not in outcomes)[:-1]: {
            name: int(row[name]) for name in outcomes
        }
        for row in rows
    }


def sentences(page):
    """Text of a page on one line."""
    return " ".join((ROOT / "docs" / page).read_text(encoding="utf-8").split())


@pytest.fixture(scope="module")
def changes():
    return rows_of("other_worlds_changes")


def test_the_outcomes_of_pairs_of_beats(changes):
    ill = changes["all", "ill by a mechanism"]
    changed = changes["all", "ill by parameters"]
    text = sentences("compare_beats.md")
    assert (
        f"Of {ill['number']} pairs with an illness of a valve {ill['right']} were named right, {ill['wrong']} wrong, "
        f"{ill['unknown']} were `unknown` and {ill['nothing']} not named; no mitral stenosis was named."
    ) in text
    assert f"Of {changed['number']} pairs with changed parameters {changed['right']} rightly named no" in text
    assert not any(
        outcome["right"] for (_, illness), outcome in changes.items() if illness == "mitral stenosis"
    )


def test_the_outcomes_of_hearts_alone():
    alone = rows_of("other_worlds_verdicts")
    healthy, ill = (alone["alone", "all", hearts] for hearts in ("healthy", "ill by a mechanism"))
    assert ill["right"] == 0
    assert (
        f"{healthy['wrong']} of {healthy['number']} healthy hearts were named in error, and none of {ill['number']} "
        "illnesses of a valve was named"
    ) in sentences("how_a_mechanism_is_named.md")
