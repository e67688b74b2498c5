"""Search hearts with and without the volume of their right ventricle: python -m benchmarks.right_ventricle

Hearts of two spheres in a closed circulation, on seeds that nothing else uses: sound ones, and effects of both sides.
Prints a line per heart and stores docs/measured/right_ventricle*.tsv. Three quarters of an hour of two cores.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from benchmarks.in_turn import searched_in_turn, spread_evenly
from benchmarks.measured_table import store_table
from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.limits import LEFT_CURVES
from heartfit.discovery.sphere_model.recording import Recording
from heartfit.observation.curve import Curve
from heartfit.results.text import spaced_name
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


@dataclass(frozen=True, eq=False)
class RightTrial:
    """A hidden effect, empty in a sound heart, and the diagnoses by the left ventricle and by both."""

    seed: int
    effect: str
    scales: float
    left: Diagnosis
    both: Diagnosis


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


def right_table(trials: Sequence[RightTrial]) -> pd.DataFrame:
    """Return a row for every effect and size: names, and the median ln Bayes factor of the effect, by both searches."""
    groups: dict[tuple[str, float], list[RightTrial]] = {}
    for trial in trials:
        groups.setdefault((trial.effect, trial.scales), []).append(trial)
    return pd.DataFrame([_row(effect, scales, some) for (effect, scales), some in sorted(groups.items())])


def _row(effect: str, scales: float, trials: Sequence[RightTrial]) -> dict[str, object]:
    left, both = ([trial.left for trial in trials], [trial.both for trial in trials])
    return {
        "effect": spaced_name(effect) if effect else "none",
        "scales": f"{scales:g}" if effect else "",
        "hearts": len(trials),
        "named by the left": _names(left, effect),
        "named by both": _names(both, effect),
        "ln Bayes factor, left": _median(left, effect),
        "ln Bayes factor, both": _median(both, effect),
    }


def _names(diagnoses: Sequence[Diagnosis], effect: str) -> str:
    """Return "2 right, 1 wrong" of the named hearts; in a sound heart every name is wrong."""
    named = [{cause.name for cause in one.mechanisms} for one in diagnoses]
    right = sum(effect in names for names in named if effect)
    return f"{right} right, {sum(bool(names) for names in named) - right} wrong"


def _median(diagnoses: Sequence[Diagnosis], effect: str) -> str:
    factors = [one.ranking[effect] for one in diagnoses if effect in one.ranking]
    return f"{np.median(factors):.1f}" if factors else "–"


def right_hearts_table(trials: Sequence[RightTrial]) -> pd.DataFrame:
    """Return a row for every heart: both verdicts, and the best mechanisms of the search of both ventricles."""
    return pd.DataFrame([_heart(trial) for trial in trials])


def _heart(trial: RightTrial) -> dict[str, object]:
    ranked = [(name, factor) for name, factor in trial.both.ranking.items() if name != "unknown"]
    best = ", ".join(f"{spaced_name(name)} {factor:.1f}" for name, factor in ranked[:2])
    return {
        "seed": trial.seed,
        "effect": spaced_name(trial.effect) if trial.effect else "none",
        "scales": f"{trial.scales:g}" if trial.effect else "",
        "left ventricle": _verdict(trial.left),
        "both ventricles": _verdict(trial.both),
        "best by both": best,
        "beats": f"{trial.left.simulations}, {trial.both.simulations}",
    }


def _verdict(diagnosis: Diagnosis) -> str:
    names = ", ".join(spaced_name(cause.name) for cause in diagnosis.mechanisms)
    return names or f"`{diagnosis.verdict}`"


if __name__ == "__main__":
    main()
