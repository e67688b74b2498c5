"""Search hearts of other simulators within the structure of controls: python -m benchmarks.other_worlds.reference

Of every file of resources/other_worlds: the hearts that are searched alone, with the next CONTROLS healthy hearts,
measured as they are, as a user's reference group. Prints a line per heart and stores
docs/measured/other_worlds_reference.tsv. Half an hour of two cores.
"""

import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from benchmarks.other_worlds.score import BANK, HEALTHY, PROCESSES, searched, store_table, tasks
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.structure import Structure, learn_from_controls
from heartfit.io.other_worlds import read_other_hearts
from heartfit.results.other_worlds import Judged, hearts_table, outcomes_table
from heartfit.synthetic.other_worlds import OtherHeart, measure

CONTROLS = 8


def main() -> None:
    """Search the hearts of all simulators and store the table."""
    judged: list[Judged] = []
    with ProcessPoolExecutor(PROCESSES) as pool:
        structures = list(pool.map(learnt, paths()))
        for one in pool.map(searched, in_turn(structures)):
            judged.append(one)
            sys.stdout.write(f"{' | '.join(map(str, hearts_table([one]).iloc[0]))}\n")
            sys.stdout.flush()
            store_table("reference", outcomes_table(judged), "reference")


def paths() -> list[Path]:
    """Return the files of the bank."""
    return sorted(BANK.glob("*.csv"))


def learnt(path: Path) -> Structure:
    """Return the structure of the controls of a simulator, which come after the healthy hearts that are searched."""
    healthy = [heart for heart in read_other_hearts(path) if not heart.illness]
    controls = healthy[HEALTHY : HEALTHY + CONTROLS]
    return learn_from_controls({str(heart.seed): Recording.from_curves(measure(heart)) for heart in controls})


def in_turn(structures: list[Structure]) -> Iterator[tuple[OtherHeart, Structure]]:
    """Yield the searched hearts, one of each simulator after the other, with the structure of their own."""
    for hearts in zip(*(tasks(path) for path in paths()), strict=True):
        for (heart, _), structure in zip(hearts, structures, strict=True):
            yield heart, structure


if __name__ == "__main__":
    main()
