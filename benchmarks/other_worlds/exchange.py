"""Search hearts of our own law with trust and within structure: python -m benchmarks.other_worlds.exchange

Hearts of the benchmark's generator, a third of them healthy, the others with one effect of SCALES scales, on seeds that
nothing else uses. Stores docs/measured/other_worlds_exchange.tsv. Half an hour of two cores.
"""

import sys
from concurrent.futures import ProcessPoolExecutor

from benchmarks.other_worlds.score import PROCESSES, store_of_worlds
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.structure import Structure
from heartfit.io.structure import read_residuals
from heartfit.results.other_worlds import Exchanged, exchange_table
from heartfit.synthetic.campaign import PlantedPlan
from heartfit.synthetic.case import plant

SEED, SCALES = 330000, 2.5
NAMES = (
    "MitralRegurgitation", "AorticRegurgitation", "MitralStenosis", "AorticStenosis", "DelayedActivation",
    "SlowRelaxation", "LengthDependence", "CatheterOffset", "CatheterDelay", "RateMismatch",
)  # fmt: skip
EACH, HEALTHY = 3, 15
"""Number of hearts with each effect, and of healthy ones."""


def main() -> None:
    """Search all hearts twice and store the table."""
    effects = [*((name,) for name in NAMES * EACH), *[()] * HEALTHY]
    plans = [
        PlantedPlan(SEED + place, "single" if names else "none", names, SCALES if names else 0.0)
        for place, names in enumerate(effects)
    ]
    with ProcessPoolExecutor(PROCESSES) as pool:
        exchanged = list(pool.map(searched, plans))
    store_of_worlds("exchange", exchange_table(exchanged), "exchange")


def searched(plan: PlantedPlan) -> Exchanged:
    """Search a planted heart with trust and within the structure of all simulators."""
    recording = Recording.from_curves(plant(plan).curves["rest"])
    structure = Structure.from_residuals(read_residuals())
    trusted, within = (diagnose(recording, structure=one) for one in (None, structure))
    sys.stdout.write(f"{plan.seed} {plan.names}: {trusted.verdict}, {within.verdict}\n")
    sys.stdout.flush()
    return Exchanged(frozenset(plan.names), trusted, within)


if __name__ == "__main__":
    main()
