"""Cells of a study's tables, each as words and numbers, and the cells in which two sets of tables differ."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import inf

import pandas as pd

from heartfit.results.stages import in_order

NUMBER = re.compile(r"(?<![\w.])[-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?!\w)")
Tables = Mapping[str, pd.DataFrame]
"""Tables of a study by name, every cell as text."""
Cell = tuple[str, int, str]
"""Table, number of the row, column; without a column the form of the whole table."""


@dataclass(frozen=True)
class Move:
    """A cell that differs: its row in words, and both texts."""

    cell: Cell
    row: str
    before: str
    now: str

    @property
    def change(self) -> float:
        """Largest change of a number in the cell; infinite if words changed."""
        if words(self.before) != words(self.now):
            return inf
        pairs = zip(numbers(self.before), numbers(self.now), strict=True)
        return max(abs(value - other) for value, other in pairs)

    def __str__(self) -> str:
        table, number, column = self.cell
        where = f"{table}, row {number + 1} ({self.row}), {column}" if column else table
        return f"{where}: {self.before or 'nothing'} before, {self.now or 'nothing'} now"


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


def words(text: str) -> str:
    """Return a text with a sign in place of each number."""
    return NUMBER.sub("#", text)


def numbers(text: str) -> list[float]:
    """Return the numbers of a text."""
    return [float(printed.replace("−", "-")) for printed in NUMBER.findall(text)]


def units(text: str) -> list[float]:
    """Return one unit of the last printed digit of each number of a text."""
    return list(map(_unit, NUMBER.findall(text)))


def _unit(printed: str) -> float:
    digits, _, exponent = printed.partition("e")
    return float(10.0 ** (int(exponent or 0) - len(digits.partition(".")[2])))


def _moves_of(name: str, before: pd.DataFrame, now: pd.DataFrame) -> Iterator[Move]:
    shapes = [f"{len(table)} rows of {', '.join(map(str, table.columns))}" for table in (before, now)]
    if shapes[0] != shapes[1]:
        yield Move((name, 0, ""), "", shapes[0], shapes[1])
        return
    wordy = [column for column in before if not before[column].map(_is_number).any()]
    for number in range(len(before)):
        row = ", ".join(text for text in before[wordy].iloc[number] if text)[:60]
        for column in before:
            texts = str(before[column].iloc[number]), str(now[column].iloc[number])
            if texts[0] != texts[1]:
                yield Move((name, number, str(column)), row, *texts)


def _is_number(text: str) -> bool:
    return NUMBER.fullmatch(text) is not None
