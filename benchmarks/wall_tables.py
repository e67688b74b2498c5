"""Searches of hearts with the strain of their wall, with a pressure and without, beside the search on the sphere."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.decide import Effects
from heartfit.discovery.sphere_model.searched_recording import NAMING_VERDICTS
from heartfit.discovery.wall_model.search import RULES
from heartfit.results.text import spaced_name

RIGHT_TERRITORY = 45.0
"""Largest error [degrees] of the middle of a territory that counts as right; a segment is 60 degrees wide."""


@dataclass(frozen=True, eq=False)
class WallResult:
    """Outcome of one search of a wall.

    gains: ln Bayes factor of the best fit of each fitted effect over the baseline; discrepancy: that of smooth
    discrepancies; angle [rad] and probability (17,) of the segments of the best effect of a region, None without one.
    """

    verdict: str
    gains: dict[str, float]
    discrepancy: float
    angle: float | None
    probability: Floats | None
    beats: int
    cpu: float

    @property
    def best(self) -> str:
        """Name of the fitted effect of the largest evidence, empty if none was fitted."""
        return max(self.gains, key=self.gains.__getitem__, default="")


@dataclass(frozen=True, eq=False)
class WallTrial:
    """A hidden effect, empty in a sound heart, and the outcomes; angle [rad] and affected (17,) of one of a region.

    images: by a search without a pressure; sphere: names by the search on the sphere; None where it was not searched.
    """

    seed: int
    effect: str
    scales: float
    angle: float | None
    affected: Floats | None
    pressure: WallResult
    images: WallResult | None = None
    sphere: Effects | None = None


def hearts_table(trials: Sequence[WallTrial]) -> pd.DataFrame:
    """Return a row for every heart."""
    return pd.DataFrame([_heart(trial) for trial in trials])


PRESSURE, IMAGES = "pressure", "images alone"
"""Searches of a heart: with a left ventricular pressure, and without any."""
SOUND, NOT_SEARCHED = "none", "–"
VERDICT, BEST, GAIN, SMOOTH, ERROR = (
    "verdict",
    "best",
    "ln B",
    "ln B of discrepancies",
    "error of the middle (deg)",
)


def _heart(trial: WallTrial) -> dict[str, object]:
    row: dict[str, object] = {
        "seed": trial.seed,
        "hidden": spaced_name(trial.effect) if trial.effect else SOUND,
        "on the sphere": NOT_SEARCHED if trial.sphere is None else _spaced(trial.sphere),
    }
    for label, result in ((PRESSURE, trial.pressure), (IMAGES, trial.images)):
        row |= {f"{label}: {name}": value for name, value in _outcome(trial, result).items()}
    return row | {"beats": trial.pressure.beats, "CPU s": f"{trial.pressure.cpu:.0f}"}


def _outcome(trial: WallTrial, result: WallResult | None) -> dict[str, str]:
    if result is None:
        return dict.fromkeys((VERDICT, BEST, GAIN, SMOOTH, ERROR), NOT_SEARCHED)
    best = result.best
    return {
        VERDICT: result.verdict,
        BEST: spaced_name(best) if best else "",
        GAIN: f"{result.gains[best]:.1f}" if best else "",
        SMOOTH: f"{result.discrepancy:.1f}",
        ERROR: _error(trial, result),
    }


def _spaced(names: Effects) -> str:
    return ", ".join(map(spaced_name, names))


def _error(trial: WallTrial, result: WallResult) -> str:
    """Error of the middle of the territory, empty where there is no territory to compare."""
    if trial.angle is None or result.angle is None or result.best != trial.effect:
        return ""
    return f"{np.rad2deg(np.abs(np.angle(np.exp(1j * (result.angle - trial.angle))))):.0f}"


def rates_table(hearts: pd.DataFrame) -> pd.DataFrame:
    """Return the rates beside their targets, of the rows of hearts as text."""
    sound = hearts[hearts["hidden"] == SOUND]
    hidden = hearts[hearts["hidden"] != SOUND]
    scars = hidden[hidden["hidden"] == "scar"]
    detected = _is_detected(hidden, PRESSURE) | _is_detected(hidden, PRESSURE, SMOOTH)
    rows = [
        ("hearts without an effect that are named", "at most 2 %", _named(sound, PRESSURE)),
        ("hearts without an effect whose verdict is unknown", "", _is_unknown(sound)),
        ("scars of 2 scales that are detected", "80 %", _seen(scars, PRESSURE)),
        ("the same by images alone", "80 %", _seen(scars, IMAGES)),
        ("scars that the sphere names", "", scars["on the sphere"] == "scar"),
        ("right territory of those detected", "90 %", _right_territory(scars, PRESSURE)),
        ("the same by images alone", "90 %", _right_territory(scars, IMAGES)),
        ("effects that are detected", "60 %", detected),
        ("names that are right", "95 %", _right_names(hidden, PRESSURE)),
        ("the same by images alone", "95 %", _right_names(hidden, IMAGES)),
    ]
    shares = [(figure, target, f"{int(holds.sum())} of {len(holds)}") for figure, target, holds in rows]
    minutes = np.median(hidden["CPU s"].astype(float)) / 60.0
    return pd.DataFrame(
        [*shares, ("CPU minutes of a search where an effect is hidden, median", "6", f"{minutes:.1f}")],
        columns=["figure", "target", "measured"],
    )


def _column(search: str, name: str) -> str:
    return f"{search}: {name}"


def _is_detected(hearts: pd.DataFrame, search: str, name: str = GAIN) -> pd.Series:
    """True where a ln Bayes factor is above the threshold; nothing was fitted where it is missing."""
    return pd.to_numeric(hearts[_column(search, name)], errors="coerce").fillna(-np.inf) > RULES.detected


def _named(hearts: pd.DataFrame, search: str) -> pd.Series:
    return hearts[_column(search, VERDICT)].isin(NAMING_VERDICTS)


def _is_unknown(hearts: pd.DataFrame) -> pd.Series:
    return hearts[_column(PRESSURE, VERDICT)] == "unknown"


def _seen(hearts: pd.DataFrame, search: str) -> pd.Series:
    best = hearts[_column(search, BEST)] == hearts["hidden"]
    return best & _is_detected(hearts, search)


def _right_territory(scars: pd.DataFrame, search: str) -> pd.Series:
    errors = pd.to_numeric(scars[_seen(scars, search)][_column(search, ERROR)], errors="coerce")
    return errors < RIGHT_TERRITORY


def _right_names(hidden: pd.DataFrame, search: str) -> pd.Series:
    named = hidden[_named(hidden, search)]
    return named[_column(search, BEST)] == named["hidden"]
