"""Diagnoses of planted hearts by the left ventricle alone and by both."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from heartfit.discovery.sphere_model.cause import Diagnosis
from heartfit.results.text import spaced_name


@dataclass(frozen=True, eq=False)
class RightTrial:
    """A hidden effect, empty in a sound heart, and the diagnoses by the left ventricle and by both."""

    seed: int
    effect: str
    scales: float
    left: Diagnosis
    both: Diagnosis


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
