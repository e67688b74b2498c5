"""Search hearts with and without the volume of their right ventricle: python -m benchmarks.right_ventricle

Hearts of two spheres in a closed circulation, on seeds that nothing else uses: sound ones, and effects of both sides.
Prints a line per heart and stores docs/measured/right_ventricle*.tsv. Three quarters of an hour of two cores.
"""

import sys
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor

import numpy as np

from benchmarks.measured_table import store_table
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.observation.curve import Curve
from heartfit.results.right_ventricle import (
    RightTrial,
    right_hearts_table,
    right_table,
)
from heartfit.roles import registered
from heartfit.synthetic.campaign import draw_effect
from heartfit.synthetic.case import draw_admissible
from heartfit.synthetic.hidden import RecordingProtocol
from heartfit.synthetic.hidden_ventricles import draw_ventricles

PROCESSES = 2
SEED = 410000
LEFT = ("lv_volume", "lv_pressure")
SOUND_HEARTS, EACH = 16, 3
EFFECTS = (
    ("MitralRegurgitation", 1.0),
    ("MitralRegurgitation", 2.0),
    ("AorticRegurgitation", 2.0),
    ("TricuspidRegurgitation", 4.0),
    ("PulmonaryRegurgitation", 4.0),
    ("PulmonaryStenosis", 4.0),
    ("TricuspidStenosis", 4.0),
    ("LateRightWall", 4.0),
)
"""Hidden effects and their sizes [scales]."""


def main() -> None:
    """Search all hearts and store the tables."""
    searched: list[RightTrial] = []
    with ProcessPoolExecutor(PROCESSES) as pool:
        for trial in pool.map(search, *zip(*plans(), strict=True)):
            searched.append(trial)
            sys.stdout.write(f"{' | '.join(map(str, right_hearts_table([trial]).iloc[0]))}\n")
            sys.stdout.flush()
            store_table("right_ventricle_hearts", right_hearts_table(searched), "benchmarks.right_ventricle")
            store_table("right_ventricle", right_table(searched), "benchmarks.right_ventricle")


def plans() -> Iterator[tuple[int, str, float]]:
    """Yield seed, effect and size of every heart, by turns, so that a stopped run has some of each."""
    order = [
        ((place + 0.5) / number, effect, scales, place)
        for effect, scales, number in (("", 0.0, SOUND_HEARTS), *((*effect, EACH) for effect in EFFECTS))
        for place in range(number)
    ]
    for number, (_, effect, scales, _) in enumerate(sorted(order)):
        yield SEED + number, effect, scales


def search(seed: int, effect: str, scales: float) -> RightTrial:
    """Diagnose a heart by its left ventricle, and by both."""
    curves = draw_admissible(seed, lambda rng, _: _curves(rng, effect, scales))
    left = diagnose(Recording.from_curves({name: curves[name] for name in LEFT}))
    return RightTrial(seed, effect, scales, left, diagnose(Recording.from_curves(curves)))


def _curves(rng: np.random.Generator, effect: str, scales: float) -> dict[str, Curve]:
    heart = draw_ventricles(rng)
    if effect:
        heart = heart.with_effects([draw_effect(registered()[effect], scales, rng)])
    return heart.measure(RecordingProtocol.draw(rng), rng)


if __name__ == "__main__":
    main()
