"""Fit the sphere to healthy hearts of all simulators; store what it leaves as src/heartfit/io/healthy_residuals.csv.

python -m benchmarks.other_worlds.learn   the first HEARTS healthy hearts of each file of resources/other_worlds, and as
many of our own model in three dimensions; a quarter of an hour of two cores
"""

import sys
from concurrent.futures import ProcessPoolExecutor

from benchmarks.in_turn import PROCESSES
from benchmarks.other_worlds.score import healthy_hearts, simulators
from benchmarks.other_worlds.ventricles import healthy_ventricles
from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.discovery.sphere_model.structure import healthy_residual
from heartfit.io.structure import HEALTHY_RESIDUALS, write_residuals
from heartfit.synthetic.other_worlds import OtherHeart, noise_free

HEARTS = 16
"""Number of healthy hearts of each simulator, so that all weigh the same."""


def main() -> None:
    """Fit all hearts and write the residuals."""
    others = [heart for path in simulators() for heart in healthy_hearts(path)[:HEARTS]]
    hearts = [*others, *healthy_ventricles(HEARTS)]
    with ProcessPoolExecutor(PROCESSES) as pool:
        residuals = list(pool.map(residual, hearts))
    keys = [(heart.world, heart.seed) for heart in hearts]
    write_residuals(HEALTHY_RESIDUALS, dict(zip(keys, residuals, strict=True)))
    sys.stdout.write(f"{len(hearts)} residuals in {HEALTHY_RESIDUALS}\n")


def residual(heart: OtherHeart) -> Floats:
    """Return what the sphere leaves of a heart that is sampled without noise."""
    return healthy_residual(Recording.from_curves(noise_free(heart)))


if __name__ == "__main__":
    main()
