"""Search ill hearts of other simulators against their own healthy beats: python -m benchmarks.other_worlds.changes

Of every file of resources/other_worlds: the first moderate heart of each illness, and the severe ones after the first,
beside which the rules were set. Prints a line per heart and stores docs/measured/other_worlds_changes.tsv and
other_worlds_change_hearts.tsv. Twenty-five minutes of two cores.
"""

from collections.abc import Iterator
from pathlib import Path

from benchmarks.other_worlds.score import judged_in_turn, simulators, store_of_worlds
from benchmarks.other_worlds.tables import AGAINST, Judged, changes_table, hearts_table
from heartfit.discovery.sphere_model.diagnose import diagnose_change
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.io.other_worlds import read_other_hearts
from heartfit.synthetic.other_worlds import OtherHeart, measure

Pair = tuple[OtherHeart, OtherHeart]
"""An ill heart and its healthy beat."""


def main() -> None:
    """Search the pairs of all simulators and store the tables."""
    for judged in judged_in_turn(searched, map(pairs, simulators())):
        store_of_worlds("changes", changes_table(judged), "changes")
        store_of_worlds("change_hearts", hearts_table(judged), "changes")


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
