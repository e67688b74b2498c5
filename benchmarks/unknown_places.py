"""Search hearts for effects that the library lacks: python -m benchmarks.unknown_places

Hearts of the benchmark's generator on seeds that nothing else uses: sound ones, effects from outside the library,
mechanisms whose entry is removed from it, and the same with the complete library. Prints a line per heart and stores
docs/measured/unknown_places*.tsv. An hour and a half of two cores.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from benchmarks.in_turn import searched_in_turn, spread_evenly
from benchmarks.measured_table import store_table
from benchmarks.place_tables import (
    COMPLETE,
    OUTSIDE,
    REMOVED,
    SOUND,
    PlaceTrial,
    forms_table,
    hearts_table,
    names_table,
    places_table,
    targets_table,
)
from heartfit.discovery.sphere_model.diagnose import conclude
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording
from heartfit.discovery.sphere_model.unknown_place import locate
from heartfit.places import PLACES, regions_of
from heartfit.synthetic.campaign import Kind, PlantedPlan, plantable
from heartfit.synthetic.case import RAISED, REST, plant
from heartfit.synthetic.out_of_library import OUT_OF_LIBRARY

SEED = 390000
SOUND_HEARTS, SCALES, EACH = 100, (2.0, 3.0, 4.0), 4
"""Number of sound hearts; sizes of hidden effects, and hearts of each effect from outside the library."""
COMPLETE_SCALES = 3.0


@dataclass(frozen=True)
class Trial:
    """A planned heart of a group, and the entries that are removed from the library."""

    group: str
    plan: PlantedPlan
    left_out: tuple[str, ...] = ()


def main() -> None:
    """Search all hearts and store the tables."""
    for searched in searched_in_turn(search, trials(), hearts_table):
        store(searched)
        if len(searched) == len(trials()):
            store_table(
                "unknown_places_targets", targets_table(places_table(searched)), "benchmarks.unknown_places"
            )


def trials() -> list[Trial]:
    """Return the trials; those of a group follow each other by turns, so that a stopped run has some of each."""
    left = [name for name, kind in plantable().items() if regions_of(kind)]
    sound = _planned(SOUND, 0, "none", [()] * SOUND_HEARTS, 0.0)
    effects = [(kind.__name__,) for kind in OUT_OF_LIBRARY] * EACH
    entries = [(name,) for name in left]
    hidden = [
        planned
        for place, scales in enumerate(SCALES)
        for planned in (
            _planned(OUTSIDE, 100 * (place + 1), "outside", effects, scales),
            _planned(REMOVED, 400 + 100 * place, "single", entries, scales),
        )
    ]
    complete = _planned(COMPLETE, 700, "single", entries, COMPLETE_SCALES)
    return spread_evenly([sound, *hidden, complete])


def _planned(
    group: str, first: int, kind: Kind, effects: Sequence[tuple[str, ...]], scales: float
) -> list[Trial]:
    hidden = group in (OUTSIDE, REMOVED)
    return [
        Trial(
            group,
            PlantedPlan(SEED + first + place, kind, names, scales, reloaded=hidden),
            names if group == REMOVED else (),
        )
        for place, names in enumerate(effects)
    ]


def search(trial: Trial) -> PlaceTrial:
    """Diagnose a planted heart without and with places, and a place also by the heart with raised legs."""
    plan = trial.plan
    curves = {name: Recording.from_curves(recorded) for name, recorded in plant(plan).curves.items()}
    first, unseen = curves[REST].halves()
    case = SearchedRecording.search(first, unseen=unseen, left_out=trial.left_out)
    before = conclude(case, {})
    after = locate(before, case, {}, PLACES)
    raised = (
        locate(before, case, {RAISED: curves[RAISED]}, PLACES) if after.acting and RAISED in curves else None
    )
    return PlaceTrial(plan.seed, trial.group, "".join(plan.names), plan.scales, before, after, raised)


def store(searched: Sequence[PlaceTrial]) -> None:
    """Write the tables of the hearts that are searched so far, and that of the places."""
    for name, table in {
        "unknown_places_forms": forms_table(),
        "unknown_places": places_table(searched),
        "unknown_places_names": names_table(searched),
        "unknown_places_hearts": hearts_table(searched),
    }.items():
        store_table(name, table, "benchmarks.unknown_places")


if __name__ == "__main__":
    main()
