"""Search hearts of other simulators, each within the structure of the others: python -m benchmarks.other_worlds.score

Of every file of resources/other_worlds: HEALTHY healthy hearts and the severe one of each illness. Prints a line per
heart and stores docs/measured/other_worlds_*.tsv. Twenty-five minutes of two cores.
"""

from collections.abc import Callable, Iterable, Iterator
from itertools import zip_longest
from pathlib import Path
from typing import TypeVar

import pandas as pd

from benchmarks.in_turn import searched_in_turn
from benchmarks.measured_table import store_table
from benchmarks.other_worlds.tables import (
    ALONE,
    Judged,
    fits_table,
    hearts_table,
    outcomes_table,
    priors_table,
)
from benchmarks.ventricles import ROOT
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.structure import Structure
from heartfit.io.other_worlds import read_other_hearts
from heartfit.io.structure import read_residuals
from heartfit.synthetic.other_worlds import OtherHeart, measure

BANK = ROOT / "resources" / "other_worlds"
HEALTHY = 4
Task = tuple[OtherHeart, Structure]
T = TypeVar("T")


def main() -> None:
    """Search the hearts of all simulators and store the tables."""
    for judged in judged_in_turn(searched, map(tasks, simulators())):
        store(judged)


def simulators() -> list[Path]:
    """Return the files of the bank."""
    return sorted(BANK.glob("*.csv"))


def judged_in_turn(
    search: Callable[[T], Judged], by_simulator: Iterable[Iterable[T]]
) -> Iterator[list[Judged]]:
    """Search one heart of each simulator after the other; print each, and yield all so far by simulator."""
    tasks = [task for some in zip_longest(*by_simulator) for task in some if task is not None]
    for judged in searched_in_turn(search, tasks, hearts_table):
        yield sorted(judged, key=lambda one: one.heart.world)


def store(judged: list[Judged]) -> None:
    """Write the tables of the hearts that are searched so far."""
    tables = {
        "verdicts": outcomes_table(judged),
        "fits": fits_table(judged),
        "hearts": hearts_table(judged),
        "priors": priors_table(),
    }
    for name, table in tables.items():
        store_of_worlds(name, table, "score")


def store_of_worlds(name: str, table: pd.DataFrame, module: str) -> None:
    """Write docs/measured/other_worlds_NAME.tsv, made by a module of this package."""
    store_table(f"other_worlds_{name}", table, f"benchmarks.other_worlds.{module}")


def tasks(path: Path) -> Iterator[Task]:
    """Yield hearts and the structure of the other simulators."""
    structure = Structure.from_residuals(read_residuals(leave_out=(path.stem,)))
    return ((heart, structure) for heart in searched_alone(path))


def searched_alone(path: Path) -> list[OtherHeart]:
    """Return the hearts of a simulator that are searched alone."""
    ill = {heart.illness: heart for heart in reversed(read_other_hearts(path)) if heart.severity == "severe"}
    return [*healthy_hearts(path)[:HEALTHY], *ill.values()]


def healthy_hearts(path: Path) -> list[OtherHeart]:
    """Return the healthy hearts of a simulator."""
    return [heart for heart in read_other_hearts(path) if not heart.illness]


def searched(task: Task) -> Judged:
    """Diagnose the measured heart."""
    heart, structure = task
    recording = Recording.from_curves(measure(heart))
    return Judged.from_diagnosis(heart, ALONE, diagnose(recording, structure=structure))


if __name__ == "__main__":
    main()
