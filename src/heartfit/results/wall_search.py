"""Searches of hearts with the strain of their wall, with a pressure and without, beside the search on the sphere."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.decide import Effects
from heartfit.discovery.sphere_model.searched_recording import NAMING_VERDICTS
from heartfit.discovery.wall_model.search import REGIONAL_RULES, RULES
from heartfit.results.cause_card import spaced_name

RIGHT_TERRITORY = np.deg2rad(45.0)
"""Largest error of the middle of a territory that counts as right; a segment is 60 degrees wide."""


@dataclass(frozen=True, eq=False)
class WallResult:
    """Outcome of one search of a wall.

    gains: ln Bayes factor of the best fit of each fitted effect over the baseline; discrepancy: that of smooth
    discrepancies; angle [rad] and probability (17,) of the segments of the best effect of a region, None without one.
    """

    verdict: str
    effects: Effects
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

    @property
    def names(self) -> Effects:
        """The named effects, empty unless the verdict names some."""
        return self.effects if self.verdict in NAMING_VERDICTS else ()


@dataclass(frozen=True, eq=False)
class WallTrial:
    """A hidden effect, empty in a sound heart, and the outcomes; angle [rad] and affected (17,) of one of a region.

    sphere: names by the search on the sphere.
    """

    seed: int
    effect: str
    scales: float
    angle: float | None
    affected: Floats | None
    pressure: WallResult
    images: WallResult
    sphere: Effects


def hearts_table(trials: Sequence[WallTrial]) -> pd.DataFrame:
    """Return a row for every heart."""
    return pd.DataFrame([_heart(trial) for trial in trials])


def _heart(trial: WallTrial) -> dict[str, object]:
    row: dict[str, object] = {
        "seed": trial.seed,
        "hidden": f"{spaced_name(trial.effect)}, {trial.scales:g} scales" if trial.effect else "none",
        "on the sphere": _spaced(trial.sphere),
    }
    for label, result in (("pressure", trial.pressure), ("images alone", trial.images)):
        row |= {
            f"{label}: verdict": result.verdict,
            f"{label}: best": _spaced((result.best,)) if result.best else "",
            f"{label}: ln B": f"{result.gains[result.best]:.1f}" if result.best else "",
            f"{label}: ln B of discrepancies": f"{result.discrepancy:.1f}",
            f"{label}: error of the middle (deg)": _error(trial, result),
        }
    return row | {"beats": trial.pressure.beats, "CPU s": f"{trial.pressure.cpu:.0f}"}


def _spaced(names: Effects) -> str:
    return ", ".join(map(spaced_name, names))


def _error(trial: WallTrial, result: WallResult) -> str:
    error = angle_error(trial, result)
    return "" if error is None else f"{np.rad2deg(error):.0f}"


def angle_error(trial: WallTrial, result: WallResult) -> float | None:
    """Error [rad] of the middle of the territory, None where there is no territory to compare."""
    if trial.angle is None or result.angle is None or result.best != trial.effect:
        return None
    return float(np.abs(np.angle(np.exp(1j * (result.angle - trial.angle)))))


def rates_table(trials: Sequence[WallTrial]) -> pd.DataFrame:
    """Return the rates beside their targets."""
    sound, hidden = ([t for t in trials if bool(t.effect) == present] for present in (False, True))
    scars = [trial for trial in hidden if trial.effect == "Scar"]
    rows = [
        (
            "hearts without an effect that are named",
            "at most 2 %",
            _share(sound, lambda t: bool(t.pressure.names)),
        ),
        ("the same by images alone", "at most 2 %", _share(sound, lambda t: bool(t.images.names))),
        (
            "scars of 2 scales that are seen",
            "80 %",
            _share(scars, lambda t: _seen(t, t.pressure)),
        ),
        ("the same by images alone", "80 %", _share(scars, lambda t: _seen(t, t.images))),
        ("scars that the sphere names", "", _share(scars, lambda t: t.sphere == ("Scar",))),
        ("right territory of those seen", "90 %", _territory(scars, lambda t: t.pressure)),
        ("the same by images alone", "90 %", _territory(scars, lambda t: t.images)),
        ("effects that are detected", "60 %", _share(hidden, lambda t: _detected(t.pressure))),
        ("names that are right", "95 %", _right_names(hidden, lambda t: t.pressure)),
        ("the same by images alone", "95 %", _right_names(hidden, lambda t: t.images)),
        ("CPU minutes of a search, median", "6", f"{np.median([t.pressure.cpu for t in trials]) / 60.0:.1f}"),
    ]
    return pd.DataFrame(rows, columns=["figure", "target", "measured"])


def _seen(trial: WallTrial, result: WallResult) -> bool:
    return result.best == trial.effect and result.gains[result.best] > REGIONAL_RULES.detected


def _detected(result: WallResult) -> bool:
    return max([*result.gains.values(), result.discrepancy]) > RULES.detected


Side = Callable[[WallTrial], WallResult]


def _territory(scars: Sequence[WallTrial], side: Side) -> str:
    errors = [angle_error(trial, side(trial)) for trial in scars if _seen(trial, side(trial))]
    return f"{sum(error is not None and error < RIGHT_TERRITORY for error in errors)} of {len(errors)}"


def _right_names(hidden: Sequence[WallTrial], side: Side) -> str:
    named = [trial for trial in hidden if side(trial).names]
    return f"{sum(trial.effect in side(trial).names for trial in named)} of {len(named)}"


def _share(trials: Sequence[WallTrial], holds: Callable[[WallTrial], bool]) -> str:
    return f"{sum(map(holds, trials))} of {len(trials)}"
