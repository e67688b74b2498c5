"""Search the hearts of other simulators; prints a line per heart and the counts, half a minute of a core per heart.

python -m benchmarks.other_worlds.score WORLD...   WORLD: name of a file of resources/other_worlds
"""

import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.io.other_worlds import read_other_hearts
from heartfit.results.other_worlds import Judged, outcomes_table
from heartfit.results.text import to_markdown
from heartfit.synthetic.other_worlds import OtherHeart, measure
from heartfit.synthetic.trial import ScoredDiagnosis

PROCESSES = 2
BANK = Path(__file__).resolve().parents[2] / "resources" / "other_worlds"
STRONGEST = 3
"""Number of mechanisms of the ranking that are printed."""


def main(worlds: list[str]) -> None:
    """Search all hearts of these worlds."""
    hearts = [heart for world in worlds for heart in read_other_hearts(BANK / f"{world}.csv")]
    with ProcessPoolExecutor(PROCESSES) as pool:
        judged = list(printed(pool.map(searched, hearts)))
    sys.stdout.write(f"\n{to_markdown(outcomes_table(judged))}")


def printed(judged: Iterator[Judged]) -> Iterator[Judged]:
    """Yield what comes, and print a line of each."""
    for one in judged:
        ranking = sorted(one.finding.ranking.items(), key=lambda entry: -entry[1])[:STRONGEST]
        factors = " ".join(f"{name} {factor:.1f}" for name, factor in ranking)
        names = " ".join(sorted(one.finding.names))
        ailment = f"{one.heart.illness} {one.heart.severity}".strip() or "healthy"
        misfits = " ".join(f"{curve} {misfit:.1f}" for curve, misfit in one.misfit.items())
        sys.stdout.write(
            f"{one.heart.world} {one.heart.seed}: {ailment} -> {one.finding.verdict} {names} ({one.outcome})"
            f" | {factors} | {misfits}\n"
        )
        sys.stdout.flush()
        yield one


def searched(heart: OtherHeart) -> Judged:
    """Measure a heart and diagnose its recording."""
    diagnosis = diagnose(Recording.from_curves(measure(heart)))
    return Judged(heart, ScoredDiagnosis.of(diagnosis, 0.0), misfits(diagnosis))


def misfits(diagnosis: Diagnosis) -> dict[str, float]:
    """Return the root mean square residual without a mechanism over that of the noise, by curve."""
    return {
        trace.curve: float(np.sqrt(np.mean(((trace.measured - trace.none) / trace.noise) ** 2)))
        for trace in diagnosis.traces
    }


if __name__ == "__main__":
    main(sys.argv[1:])
