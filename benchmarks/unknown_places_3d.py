"""Search three-dimensional hearts for effects that the library lacks: python -m benchmarks.unknown_places_3d

Hearts of the benchmark in three dimensions, observed through images and registration, on seeds that nothing else uses:
effects from outside the library, mechanisms whose entry is removed from it, and sound ones. The sphere is centred on
one beat of the diagnoser's mesh. Stores docs/measured/unknown_places_3d*.tsv; a quarter of an hour of two cores.
"""

from benchmarks.in_turn import searched_in_turn
from benchmarks.measured_table import store_table
from benchmarks.planted_ventricles import sphere_reference, ventricles
from benchmarks.unknown_places import Trial
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.places import PLACES
from heartfit.results.unknown_places import OUTSIDE, REMOVED, SOUND, PlaceTrial, hearts_table, places_table
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.case import REST
from heartfit.synthetic.out_of_library import OUT_OF_LIBRARY

MODULE = "benchmarks.unknown_places_3d"
SEED, SCALES, SOUND_HEARTS = 380000, 3.0, 4
LEFT_OUT = (
    *("AorticRegurgitation", "AorticStenosis", "AtrialSurge", "CatheterDelay"),
    *("DelayedActivation", "MitralRegurgitation", "SeptalLoad", "SlowRelaxation"),
)


def main() -> None:
    """Search all hearts and store the tables."""
    for searched in searched_in_turn(search, trials(), hearts_table):
        table = places_table(searched).drop(columns="helps with raised legs")
        store_table("unknown_places_3d", table, MODULE)
        store_table("unknown_places_3d_hearts", hearts_table(searched).drop(columns="library alone"), MODULE)


def trials() -> list[Trial]:
    """Return the planned hearts."""
    outside = [(OUTSIDE, kind.__name__) for kind in OUT_OF_LIBRARY]
    removed = [(REMOVED, name) for name in LEFT_OUT]
    hidden = [
        Trial(
            group,
            PlantedPlan(SEED + number, "outside" if group == OUTSIDE else "single", (name,), SCALES),
            (name,) if group == REMOVED else (),
        )
        for number, (group, name) in enumerate([*outside, *removed])
    ]
    sound = [
        Trial(SOUND, PlantedPlan(SEED + 100 + number, "none", (), 0.0)) for number in range(SOUND_HEARTS)
    ]
    return [*hidden, *sound]


def search(trial: Trial) -> PlaceTrial:
    """Diagnose a planted heart with places."""
    plan = trial.plan
    imaged, case = ventricles().plant(plan)
    diagnosed = sphere_reference(imaged).search(
        Recording.from_curves(case.curves[REST]), PLACES, trial.left_out
    )
    return PlaceTrial(plan.seed, trial.group, "".join(plan.names), plan.scales, diagnosed, diagnosed)


if __name__ == "__main__":
    main()
