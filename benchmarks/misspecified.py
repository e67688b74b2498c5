"""Search of misspecified hearts for tuning: prints a line per case, and the rates; half a minute of a core per case.

`python -m benchmarks.misspecified FIRST_SEED NULLS SINGLES`: number of nulls, and of cases per mechanism.
"""

import sys
from concurrent.futures import ProcessPoolExecutor

from heartfit.discovery.sphere_model.recording import Recording
from heartfit.results.planted_table import populations_table
from heartfit.results.text import to_markdown
from heartfit.study.discovery import SCORING
from heartfit.synthetic.campaign import PlantedPlan, misspecified_plans, plantable
from heartfit.synthetic.case import REST, plant
from heartfit.synthetic.scoring import Scored
from heartfit.synthetic.trial import diagnose_recording

PROCESSES, SCALES = 2, 2.5
"""Number of processes, and size of the effects [scales]."""
STRONGEST = 3
"""Number of mechanisms of the ranking that are printed."""


def main(arguments: list[str]) -> None:
    """Search the planned cases; raises SystemExit for seeds that are reserved for scoring."""
    first_seed, nulls, singles = map(int, arguments)
    plans = misspecified_plans(first_seed, nulls, singles, SCALES, plantable())
    if first_seed + len(plans) > SCORING:
        raise SystemExit(f"seeds from {SCORING} on are reserved for scoring; choose a smaller FIRST_SEED")
    scored = []
    with ProcessPoolExecutor(PROCESSES) as pool:
        for case in pool.map(searched, plans):
            scored.append(case)
            sys.stdout.write(f"{line(case)}\n")
            sys.stdout.flush()
    sys.stdout.write(f"\n{to_markdown(populations_table(scored))}")


def searched(plan: PlantedPlan) -> Scored:
    """Plant a case and diagnose its recording."""
    case = plant(plan)
    return Scored(case.answer, diagnose_recording(Recording.from_curves(case.curves[REST])))


def line(case: Scored) -> str:
    """Return seed, departure, planted effect, verdict and the head of the ranking of a case."""
    departure = case.answer.misspecification
    errors = f"errors {departure.volume_noise:g} {departure.catheter_noise:g} {departure.memory:g}"
    centres = " ".join(f"{name.split('.')[-1]} {shift:+.1f}" for name, shift in departure.centres.items())
    ranking = sorted(case.finding.ranking.items(), key=lambda entry: -entry[1])[:STRONGEST]
    factors = " ".join(f"{name} {factor:.1f}" for name, factor in ranking)
    return (
        f"{case.answer.seed}: {case.planted} -> {case.finding.verdict} {' '.join(sorted(case.finding.names))}"
        f" | {factors} | R wave {1e3 * departure.trigger_lead:.0f} ms, {errors}, {centres}"
    )


if __name__ == "__main__":
    main(sys.argv[1:])
