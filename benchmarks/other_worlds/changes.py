"""Search ill hearts of other simulators against their own healthy beats: python -m benchmarks.other_worlds.changes

Of every file of resources/other_worlds: the first moderate heart of each illness, and the severe ones after the first,
beside which the rules were set. Prints a line per heart and stores docs/measured/other_worlds_changes.tsv and
other_worlds_change_hearts.tsv. Twenty-five minutes of two cores.
"""

import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from itertools import zip_longest
from pathlib import Path

from benchmarks.other_worlds.score import BANK, PROCESSES, store_table
from heartfit.discovery.sphere_model.diagnose import diagnose_change
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.io.other_worlds import read_other_hearts
from heartfit.results.other_worlds import AGAINST, Judged, changes_table, hearts_table
from heartfit.synthetic.other_worlds import OtherHeart, measure

Pair = tuple[OtherHeart, OtherHeart]
"""An ill heart and its healthy beat."""


def main() -> None:
    """Search the pairs of all simulators and store the tables."""
    judged: list[Judged] = []
    by_simulator = [list(pairs(path)) for path in sorted(BANK.glob("*.csv"))]
    in_turn = [pair for some in zip_longest(*by_simulator) for pair in some if pair is not None]
    with ProcessPoolExecutor(PROCESSES) as pool:
        for one in pool.map(searched, in_turn):
            judged.append(one)
            sys.stdout.write(f"{' | '.join(map(str, hearts_table([one]).iloc[0]))}\n")
            sys.stdout.flush()
            ordered = sorted(judged, key=lambda one: one.heart.world)
            store_table("changes", changes_table(ordered), "changes")
            store_table("change_hearts", hearts_table(ordered), "changes")


def pairs(path: Path) -> Iterator[Pair]:
    """Yield the pairs of a simulator on which no rule was set."""
    hearts = read_other_hearts(path)
    healthy = {heart.seed: heart for heart in hearts if not heart.illness}
    severe = [heart for heart in hearts if heart.severity == "severe"]
    first = {heart.illness: heart for heart in reversed(severe)}
    moderate = {heart.illness: heart for heart in reversed(hearts) if heart.severity == "moderate"}
    others = [heart for heart in severe if heart not in first.values()]
    for heart in (*others, *moderate.values()):
        yield heart, healthy[heart.seed]


def searched(pair: Pair) -> Judged:
    """Diagnose the measured heart against its healthy beat."""
    after, earlier = (Recording.from_curves(measure(one)) for one in pair)
    return Judged.from_diagnosis(pair[0], AGAINST, diagnose_change(after, earlier))


if __name__ == "__main__":
    main()
