"""Drift of a study's tables from stored ones: every number and every word, cell by cell.

Where the same processor and the same software made both, each cell must be the same. Elsewhere libraries round
otherwise, and a cell may differ as the runs of an ensemble do, which differ in rounding alone.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from heartfit.results.cells import Move, Tables, find_moves
from heartfit.results.ensemble import Ensemble


@dataclass(frozen=True, eq=False)
class StoredTables:
    """Tables that a study is held to, the machine that made them, and the ensemble of their study, if it was run.

    machine: software and processor, by what they are.
    """

    tables: Tables
    machine: Mapping[str, str]
    ensemble: Ensemble | None = None

    def compared(self, tables: Tables, machine: Mapping[str, str]) -> "Drift":
        """Return the comparison of a study's tables, which this machine made, with the stored ones.

        Further tables, made on request, are not compared.
        """
        moves, same = find_moves(self.tables, tables), machine == self.machine
        held = None if same else self.ensemble
        drifted = [move for move in moves if held is None or not held.holds(move)]
        cells = sum(table.size for table in self.tables.values())
        return Drift(moves, drifted, cells, same, judged=same or held is not None)


@dataclass(frozen=True, eq=False)
class Drift:
    """Cells that differ from the stored ones, those that drifted among them, and the number of compared cells.

    moves, drifted: in the order of the study, so that the others may follow from the first; judged: False on another
    processor or software where it is not known what these move.
    """

    moves: Sequence[Move]
    drifted: Sequence[Move]
    cells: int
    same_machine: bool
    judged: bool

    def line(self, listed_in: str, left_out: str = "") -> str:
        """Return in one line whether the tables agree with the stored ones; listed_in: file that lists the cells."""
        if left_out:
            return f"The tables are not compared with the stored ones: {left_out}"
        if not self.moves:
            return f"The tables agree with the stored ones: each of {self.cells} cells is the same."
        if not self.drifted:
            return (
                f"The tables agree with the stored ones: {len(self.moves)} of {self.cells} cells moved, none by more "
                "than rounding moves them."
            )
        here = (
            "the processor and software of the stored ones"
            if self.same_machine
            else "another processor or software"
            if self.judged
            else "another processor or software, of which it is not known what it moves"
        )
        return (
            f"{len(self.drifted)} of {self.cells} cells lie outside the stored tables, on {here}; the first in the "
            f"order of the study: {self.drifted[0]}. {listed_in} lists them; docs/what_the_numbers_mean.md#drift says "
            "what that means."
        )

    def table(self) -> pd.DataFrame:
        """Return one row for each cell that differs: its place, both texts, change, and whether it drifted."""
        columns = ["table", "row", "column", "before", "now", "change", "drifted"]
        rows = [
            (*move.cell, move.before, move.now, move.change, "yes" if move in self.drifted else "no")
            for move in self.moves
        ]
        return pd.DataFrame(rows, columns=columns)


def drift_table(drift: Drift, left_out: str = "") -> pd.DataFrame:
    """Return the table of a drift; where cases are left out, one row with the reason: other tables are no drift."""
    return pd.DataFrame({"not compared": [left_out]}) if left_out else drift.table()
