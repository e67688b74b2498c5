r"""Drift of a study's tables from stored ones: every number and every word, cell by cell.

Where the same processor and the same software made both, each cell must be the same. Elsewhere libraries round
otherwise, and a number may move by

.. math:: |v - v_0| \le 10^{-3} |v_0| + u + 3 m ,

where u is one unit of the last printed digit and m what this cell moved on another processor. A cell of text counts as
its words and the numbers in it; its words may change only where they did on another processor.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import inf

import pandas as pd

from heartfit.results.stages import in_order

RELATIVE = 1e-3
"""Share by which a number may move on another processor."""
MARGIN = 3.0
"""Allowance for a third processor, in moves of the cell on a second one."""
NUMBER = re.compile(r"(?<![\w.])[-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?!\w)")
Tables = Mapping[str, pd.DataFrame]
"""Tables of a study by name, every cell as text."""
Cell = tuple[str, int, str]
"""Table, number of the row, column."""


@dataclass(frozen=True)
class Move:
    """A cell that differs: its row in words, both texts, and the change of its numbers, infinite if words changed.

    unit: one unit of the last printed digit; size: magnitude of the stored number that changed most.
    """

    cell: Cell
    row: str
    before: str
    now: str
    change: float = inf
    unit: float = 0.0
    size: float = 0.0

    def allowed(self, elsewhere: float = 0.0) -> float:
        """Return the largest change on another processor; elsewhere: change of the cell on a second one."""
        return RELATIVE * self.size + self.unit + MARGIN * elsewhere

    def __str__(self) -> str:
        table, number, column = self.cell
        where = f"{table}, row {number + 1} ({self.row}), {column}" if column else table
        return f"{where}: {self.before or 'nothing'} before, {self.now or 'nothing'} now"


@dataclass(frozen=True, eq=False)
class StoredTables:
    """Tables that a study is held to, the machine that made them, and changes of cells on other processors.

    machine: software and processor, by what they are; elsewhere: only changes beyond the general allowance.
    """

    tables: Tables
    machine: Mapping[str, str]
    elsewhere: Mapping[Cell, float]

    def compared(self, tables: Tables, machine: Mapping[str, str]) -> "Drift":
        """Return the comparison of a study's tables, which this machine made, with the stored ones.

        Further tables, made on request, are not compared.
        """
        moves = find_moves(self.tables, tables)
        same = machine == self.machine
        drifted = [
            move
            for move in moves
            if same or not move.change <= move.allowed(self.elsewhere.get(move.cell, 0.0))
        ]
        cells = sum(table.size for table in self.tables.values())
        return Drift(moves, drifted, cells, same, judged=same or bool(self.elsewhere))

    def with_processor(self, tables: Tables) -> dict[Cell, float]:
        """Return the changes on other processors and in these tables of one more: the larger of each cell."""
        new = {
            move.cell: move.change
            for move in find_moves(self.tables, tables)
            if not move.change <= move.allowed()
        }
        cells = sorted({*self.elsewhere, *new})
        return {cell: max(self.elsewhere.get(cell, 0.0), new.get(cell, 0.0)) for cell in cells}


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
                "than processors differ."
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


def find_moves(stored: Tables, tables: Tables) -> list[Move]:
    """Return every stored cell that differs, in the order in which a study makes the tables.

    A missing table, other columns or rows are one move without a column.
    """
    moves: list[Move] = []
    for name in in_order(stored):
        if name in tables:
            moves.extend(_moves_of(name, stored[name], tables[name]))
        else:
            moves.append(Move((name, 0, ""), "", "a table", ""))
    return moves


def _moves_of(name: str, before: pd.DataFrame, now: pd.DataFrame) -> Iterator[Move]:
    shapes = [f"{len(table)} rows of {', '.join(map(str, table.columns))}" for table in (before, now)]
    if shapes[0] != shapes[1]:
        yield Move((name, 0, ""), "", shapes[0], shapes[1])
        return
    words = [column for column in before if not before[column].map(_is_number).any()]
    for number in range(len(before)):
        row = ", ".join(text for text in before[words].iloc[number] if text)[:60]
        for column in before:
            texts = str(before[column].iloc[number]), str(now[column].iloc[number])
            if texts[0] != texts[1]:
                yield _move((name, number, str(column)), row, *texts)


def _move(cell: Cell, row: str, before: str, now: str) -> Move:
    if NUMBER.sub("#", before) != NUMBER.sub("#", now):
        return Move(cell, row, before, now)
    pairs = list(zip(NUMBER.findall(before), NUMBER.findall(now), strict=True))
    worst = max(pairs, key=lambda pair: _change(*pair) / (RELATIVE * abs(_value(pair[0])) + _unit(pair[0])))
    return Move(cell, row, before, now, _change(*worst), _unit(worst[0]), abs(_value(worst[0])))


def _is_number(text: str) -> bool:
    return NUMBER.fullmatch(text) is not None


def _change(before: str, now: str) -> float:
    return abs(_value(before) - _value(now))


def _value(printed: str) -> float:
    return float(printed.replace("−", "-"))


def _unit(printed: str) -> float:
    """One unit of the last printed digit."""
    digits, _, exponent = printed.partition("e")
    decimals = len(digits.partition(".")[2])
    return float(10.0 ** (int(exponent or 0) - decimals))
