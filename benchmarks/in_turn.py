"""Hearts of a benchmark, searched in turn on all processes and spread evenly over their groups."""

import pickle
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import TypeVar

import pandas as pd

PROCESSES = 2

P = TypeVar("P")
T = TypeVar("T")


def searched_in_turn(
    search_one: Callable[[P], T], planned: Sequence[P], table: Callable[[list[T]], pd.DataFrame]
) -> Iterator[list[T]]:
    """Search planned hearts on all processes; print the row of each in a table, and yield all so far."""
    searched: list[T] = []
    with ProcessPoolExecutor(PROCESSES) as pool:
        for one in pool.map(search_one, planned):
            searched.append(one)
            sys.stdout.write(f"{' | '.join(map(str, table([one]).iloc[0]))}\n")
            sys.stdout.flush()
            yield searched


def spread_evenly(groups: Sequence[Sequence[P]]) -> list[P]:
    """Return the members of all groups, each spread evenly, so that a stopped run has the same share of each."""
    order = [((place + 0.5) / len(group), one) for group in groups for place, one in enumerate(group)]
    return [one for _, one in sorted(order, key=lambda entry: entry[0])]


def kept_on_disk(path: Path, make: Callable[[], T]) -> T:
    """Return what the file holds; make and write it first if there is none, completely or not at all."""
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished = path.with_suffix(".part")
        unfinished.write_bytes(pickle.dumps(make()))
        unfinished.rename(path)
    kept: T = pickle.loads(path.read_bytes())
    return kept
