r"""Numerical error of every number of a study, from an ensemble of runs that differ in rounding alone.

A cell agrees with an ensemble of n runs, of mean m and standard deviation s, if its words are those of a member and
each of its numbers v obeys

.. math:: |v - m| \le t \sqrt{s^2 (1 + 1/n) + f^2 m^2} + u , \qquad f = 10^{-4} ,

with the quantile t of Student's distribution of n - 1 degrees of freedom at which one run in a hundred would have any
of its numbers outside, the unit u of the last printed digit, and a floor f, as few runs may agree by chance.
"""

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from math import inf

import numpy as np
import pandas as pd
from scipy.stats import t as student

from heartfit.results.cells import Cell, Move, Tables, find_moves, numbers, units, words

FLOOR = 1e-4
"""Relative floor of a standard deviation."""
LEVEL = 0.01
"""Probability that any number of a run that differs in rounding alone lies outside."""
UNHELD = ("meshes",)
"""Tables of which a member tells nothing: the hash of a moved mesh is another one."""
MOST_DIGITS = 6
"""Digits that a table prints."""
COLUMNS = ["table", "row", "column", "words", "number", "members", "mean", "sd"]


@dataclass(frozen=True)
class Spread:
    """Mean and standard deviation of one number over the members that print it."""

    members: int
    mean: float
    sd: float

    @property
    def digits(self) -> float:
        """Significant digits, -log10(sd / |mean|), between 0 and the printed ones (Parker, CSD-970002, 1997)."""
        if self.sd == 0.0:
            return MOST_DIGITS
        return float(np.clip(np.log10(abs(self.mean) / self.sd), 0.0, MOST_DIGITS)) if self.mean else 0.0


@dataclass(frozen=True, eq=False)
class Ensemble:
    """Spreads of the numbers in each cell that members moved, by the words around them; all others never moved.

    members: number of runs; tested: numbers in all cells.
    """

    members: int
    tested: int
    spreads: Mapping[Cell, Mapping[str, Sequence[Spread]]]

    @classmethod
    def of(cls, stored: Tables, members: Sequence[Tables]) -> "Ensemble":
        """Return the ensemble of the tables of at least two runs, whose cells are those of stored tables."""
        return cls._of_moves(stored, [_held_moves(stored, tables) for tables in members])

    @classmethod
    def _of_moves(cls, stored: Tables, moves: Sequence[Sequence[Move]]) -> "Ensemble":
        """Return the ensemble of runs by the cells in which each differs from stored tables."""
        printed: dict[Cell, list[str]] = defaultdict(list)
        reshaped: Counter[str] = Counter()
        before: dict[Cell, str] = {}
        for move in chain.from_iterable(moves):
            printed[move.cell].append(move.now)
            before[move.cell] = move.before
            reshaped[move.cell[0]] += not move.cell[2]
        for (table, row, column), texts in printed.items():
            same_form = len(moves) - (reshaped[table] if column else 0)
            texts += [before[table, row, column]] * (same_form - len(texts))
        held = (table for name, table in stored.items() if name not in UNHELD)
        tested = sum(len(numbers(text)) for table in held for text in table.to_numpy().ravel())
        spreads = {cell: _spreads(cell, texts) for cell, texts in printed.items()}
        return cls(len(moves), tested, spreads)

    def holds(self, move: Move) -> bool:
        """True if a cell that differs from the stored one is one of this ensemble, as far as can be told."""
        by_words = {**_spreads(move.cell, [move.before] * self.members), **self.spreads.get(move.cell, {})}
        stated, values = _read(move.cell, move.now)
        if stated not in by_words:
            return False
        # a table drops the zeros at the end of a number
        printed = map(
            min, units(move.now), units(move.before) if stated == words(move.before) else units(move.now)
        )
        return all(map(self._is_near, by_words[stated], values, printed))

    def _is_near(self, spread: Spread, value: float, unit: float) -> bool:
        sd = np.hypot(spread.sd * np.sqrt(1.0 + 1.0 / spread.members), FLOOR * spread.mean)
        return bool(abs(value - spread.mean) <= self._quantile * sd + unit * (1.0 + 1e-9))

    @cached_property
    def _quantile(self) -> float:
        """Quantile of Student's distribution for one number of all, on both sides."""
        return float(student.ppf(1.0 - 0.5 * LEVEL / max(self.tested, 1), max(self.members - 1, 1)))

    def digits(self, cell: Cell, text: str) -> float:
        """Significant digits of the worst number of a stored cell; infinite for a cell of words alone."""
        stated, _ = _read(cell, text)
        spreads = self.spreads.get(cell, {}).get(stated) or _spreads(cell, [text])[stated]
        return min((spread.digits for spread in spreads), default=inf)

    def table(self) -> pd.DataFrame:
        """Return one row for each number of each cell that moved; one without a number for words alone."""
        rows = [
            (*cell, text, place, *entry)
            for cell, by_words in self.spreads.items()
            for text, spreads in by_words.items()
            for place, entry in _numbered(spreads)
        ]
        return pd.DataFrame(rows, columns=COLUMNS)

    @classmethod
    def from_table(cls, table: pd.DataFrame, members: int, tested: int) -> "Ensemble":
        """Return the ensemble of a table of `table`."""
        read: dict[Cell, dict[str, list[Spread]]] = defaultdict(lambda: defaultdict(list))
        for row in table.to_dict("records"):
            spreads = read[row["table"], int(row["row"]), row["column"]][row["words"]]
            if row["number"]:
                spreads.append(Spread(int(row["members"]), float(row["mean"]), float(row["sd"])))
        return cls(members, tested, {cell: dict(by_words) for cell, by_words in read.items()})


def leave_one_out(stored: Tables, members: Mapping[str, Tables]) -> dict[str, list[Move]]:
    """Return of each member the cells that lie outside the ensemble of the others."""
    moves = {name: _held_moves(stored, tables) for name, tables in members.items()}
    outside: dict[str, list[Move]] = {}
    for name, own in moves.items():
        others = Ensemble._of_moves(stored, [other for key, other in moves.items() if key != name])
        outside[name] = [move for move in own if not others.holds(move)]
    return outside


def _held_moves(stored: Tables, tables: Tables) -> list[Move]:
    """Cells of the tables of which a member tells something that differ from the stored ones."""
    return find_moves({name: table for name, table in stored.items() if name not in UNHELD}, tables)


def _read(cell: Cell, text: str) -> tuple[str, list[float]]:
    """Words and numbers of a cell; the form of a table is words alone."""
    return (words(text), numbers(text)) if cell[2] else (text, [])


def _spreads(cell: Cell, texts: Sequence[str]) -> dict[str, list[Spread]]:
    """Spreads of the numbers of a cell in runs, by the words around them."""
    by_words: dict[str, list[list[float]]] = defaultdict(list)
    for stated, values in (_read(cell, text) for text in texts):
        by_words[stated].append(values)
    return {
        stated: [
            Spread(len(rows), float(np.mean(column)), _deviation(column))
            for column in zip(*rows, strict=True)
        ]
        for stated, rows in by_words.items()
    }


def _deviation(values: Sequence[float]) -> float:
    return float(np.std(values, ddof=1)) if len(values) > 1 else 0.0


def _numbered(spreads: Sequence[Spread]) -> Iterator[tuple[object, tuple[object, object, object]]]:
    """Place and entries of each spread; one empty entry if there is none."""
    if not spreads:
        yield "", ("", "", "")
    for place, spread in enumerate(spreads, start=1):
        yield place, (spread.members, spread.mean, spread.sd)
