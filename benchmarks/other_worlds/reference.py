"""Search hearts of other simulators within the structure of controls: python -m benchmarks.other_worlds.reference

Of every file of resources/other_worlds: the hearts that are searched alone, with the next CONTROLS healthy hearts,
measured as they are, as a user's reference group. Prints a line per heart and stores
docs/measured/other_worlds_reference.tsv. Half an hour of two cores.
"""

from collections.abc import Iterator
from pathlib import Path

from benchmarks.other_worlds.score import (
    HEALTHY,
    Task,
    healthy_hearts,
    judged_in_turn,
    searched,
    searched_alone,
    simulators,
    store_of_worlds,
)
from benchmarks.other_worlds.tables import outcomes_table
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.structure import Structure, learn_from_controls
from heartfit.synthetic.other_worlds import measure

CONTROLS = 8


def main() -> None:
    """Search the hearts of all simulators and store the table."""
    for judged in judged_in_turn(searched, map(tasks_within_controls, simulators())):
        store_of_worlds("reference", outcomes_table(judged), "reference")


def tasks_within_controls(path: Path) -> Iterator[Task]:
    """Yield the hearts of a simulator that are searched alone, and the structure of its controls."""
    structure = learnt(path)
    return ((heart, structure) for heart in searched_alone(path))


def learnt(path: Path) -> Structure:
    """Return the structure of the controls of a simulator, which come after the healthy hearts that are searched."""
    controls = healthy_hearts(path)[HEALTHY : HEALTHY + CONTROLS]
    return learn_from_controls({str(heart.seed): Recording.from_curves(measure(heart)) for heart in controls})


if __name__ == "__main__":
    main()
