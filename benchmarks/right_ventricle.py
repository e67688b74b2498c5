"""Search hearts with and without the volume of their right ventricle: python -m benchmarks.right_ventricle

Hearts of two spheres in a closed circulation, on seeds that nothing else uses: sound ones, and effects of both sides.
Prints a line per heart and stores docs/measured/right_ventricle*.tsv. Three quarters of an hour of two cores.
"""

import numpy as np

from benchmarks.in_turn import searched_in_turn, spread_evenly
from benchmarks.measured_table import store_table
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.limits import LEFT_CURVES
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

SEED = 410000
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


Plan = tuple[int, str, float]
"""Seed, effect, empty in a sound heart, and size of a heart."""


def main() -> None:
    """Search all hearts and store the tables."""
    for searched in searched_in_turn(search, plans(), right_hearts_table):
        store_table("right_ventricle_hearts", right_hearts_table(searched), "benchmarks.right_ventricle")
        store_table("right_ventricle", right_table(searched), "benchmarks.right_ventricle")


def plans() -> list[Plan]:
    """Return the planned hearts."""
    sound, ill = [("", 0.0)] * SOUND_HEARTS, [[effect] * EACH for effect in sorted(EFFECTS)]
    return [(SEED + number, *effect) for number, effect in enumerate(spread_evenly([sound, *ill]))]


def search(plan: Plan) -> RightTrial:
    """Diagnose a heart by its left ventricle, and by both."""
    seed, effect, scales = plan
    curves = draw_admissible(seed, lambda rng, _: _curves(rng, effect, scales))
    left = diagnose(Recording.from_curves({name: curves[name] for name in LEFT_CURVES}))
    return RightTrial(seed, effect, scales, left, diagnose(Recording.from_curves(curves)))


def _curves(rng: np.random.Generator, effect: str, scales: float) -> dict[str, Curve]:
    heart = draw_ventricles(rng)
    if effect:
        heart = heart.with_effects([draw_effect(registered()[effect], scales, rng)])
    return heart.measure(RecordingProtocol.draw(rng), rng)


if __name__ == "__main__":
    main()
