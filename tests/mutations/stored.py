"""Stored verdicts on mutants, docs/measured/mutations.tsv.

A verdict is kept as long as its mutant does not change: trying all of them takes more than half an hour.
"""

import sys
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime

from tests.mutations.catalogue import MUTANTS
from tests.mutations.mutant import Mutant
from tests.mutations.run import ROOT, Verdict, verdicts

STORED = ROOT / "docs" / "measured" / "mutations.tsv"
MADE_BY = "# made by: python3 study.py mutations"
HEAD = ("mutant", "of", "instead of", "caught by", "tried")
NOBODY = "**nobody**"

Row = tuple[str, ...]
"""Cells of a mutant, as HEAD names them."""


def key(mutant: Mutant) -> Row:
    """The first cells of a mutant, which say what it changes."""
    old, new = (f"`{_in_one_line(text)}`" if text.strip() else "nothing" for text in (mutant.old, mutant.new))
    return mutant.what, f"`{mutant.file}`: {new}", old


def _in_one_line(code: str) -> str:
    return " ".join(code.split()).replace("|", "\\|")


def row(verdict: Verdict, day: str) -> Row:
    """The cells of a mutant that was tried on a day."""
    caught = f"`{verdict.caught_by}`" if verdict.caught_by else NOBODY
    return *key(verdict.mutant), caught, day


def read_rows() -> dict[Row, Row]:
    """The stored rows by what their mutant changes."""
    lines = STORED.read_text(encoding="utf-8").splitlines()[2:]
    rows = [tuple(line.split("\t")) for line in lines]
    return {cells[:3]: cells for cells in rows}


def write_rows(rows: Mapping[Row, Row]) -> None:
    """Store the rows of the listed mutants, in the order of the list."""
    kept = [rows[key(mutant)] for mutant in MUTANTS if key(mutant) in rows]
    lines = [MADE_BY, *("\t".join(cells) for cells in (HEAD, *kept))]
    STORED.write_text("\n".join(lines) + "\n", encoding="utf-8")


def chosen(arguments: Sequence[str]) -> list[Mutant]:
    """The mutants to try: those that are named, with --all every one, else those without a stored row.

    Raises SystemExit for a name that no mutant has.
    """
    if arguments == ["--all"]:
        return list(MUTANTS)
    if unknown := set(arguments) - {mutant.what for mutant in MUTANTS}:
        raise SystemExit(f"no mutant {', '.join(sorted(unknown))}: see docs/measured/mutations.tsv")
    rows = read_rows()
    return [
        mutant for mutant in MUTANTS if mutant.what in arguments or not (arguments or key(mutant) in rows)
    ]


def main(arguments: Sequence[str]) -> int:
    """Try mutants and store each verdict; 1 if one survives."""
    rows, survived = read_rows(), 0
    for verdict in verdicts(chosen(arguments)):
        day = datetime.now(UTC).date().isoformat()
        rows[key(verdict.mutant)] = row(verdict, day)
        write_rows(rows)
        survived += not verdict.caught_by
        sys.stderr.write(f"{verdict.mutant.what}: {verdict.caught_by or 'SURVIVED'}\n")
    write_rows(rows)
    return int(survived > 0)
