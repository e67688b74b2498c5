"""Search hearts of other simulators for places, without the mechanism of their illness.

python -m benchmarks.unknown_places_elsewhere

Of every file of resources/other_worlds a healthy heart and the severe ones with a leaking valve, each within the
structure of the other simulators, the library without the mechanism of the illness. Stores
docs/measured/unknown_places_elsewhere.tsv; a quarter of an hour of two cores.
"""

import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor

from benchmarks.measured_table import store_table
from benchmarks.other_worlds.score import healthy_hearts, searched_alone, simulators
from benchmarks.unknown_places import PROCESSES
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.structure import Structure
from heartfit.io.structure import read_residuals
from heartfit.places import PLACES
from heartfit.results.unknown_places import REMOVED, SOUND, PlaceTrial, hearts_table
from heartfit.synthetic.other_worlds import OtherHeart, measure

MODULE = "benchmarks.unknown_places_elsewhere"
LEAKS = {"mitral regurgitation": "MitralRegurgitation", "aortic regurgitation": "AorticRegurgitation"}
"""Mechanism of the library by illness."""
Task = tuple[OtherHeart, Structure]


def main() -> None:
    """Search all hearts and store the table."""
    searched: list[tuple[str, PlaceTrial]] = []
    with ProcessPoolExecutor(PROCESSES) as pool:
        for one in pool.map(search, tasks()):
            searched.append(one)
            table = hearts_table([trial for _, trial in searched]).drop(columns=["library alone", "scales"])
            table.insert(0, "simulator", [name for name, _ in searched])
            sys.stdout.write(f"{' | '.join(map(str, table.iloc[-1]))}\n")
            sys.stdout.flush()
            store_table("unknown_places_elsewhere", table, MODULE)


def tasks() -> Iterator[Task]:
    """Yield hearts and the structure of the other simulators."""
    for path in simulators():
        structure = Structure.from_residuals(read_residuals(leave_out=(path.stem,)))
        ill = [heart for heart in searched_alone(path) if heart.illness in LEAKS]
        yield from ((heart, structure) for heart in [*ill, healthy_hearts(path)[0]])


def search(task: Task) -> tuple[str, PlaceTrial]:
    """Diagnose the measured heart with places."""
    heart, structure = task
    effect = LEAKS.get(heart.illness, "")
    recording = Recording.from_curves(measure(heart))
    left_out = (effect,) if effect else ()
    diagnosed = diagnose(recording, structure=structure, places=PLACES, left_out=left_out)
    group = REMOVED if effect else SOUND
    return heart.world, PlaceTrial(heart.seed, group, effect, 0.0, diagnosed, diagnosed)


if __name__ == "__main__":
    main()
