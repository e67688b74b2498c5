"""A planted case: what is measured of a hidden heart, and the answer, apart."""

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from heartfit.beat import Beat
from heartfit.mechanism import Mechanism
from heartfit.observation.curve import PRESSURES, Curve
from heartfit.planting.campaign import Kind, Plan
from heartfit.planting.effects import Effect, Inadmissible, described, draw_effect, plantable
from heartfit.planting.hidden import NUMERICS, HiddenHeart, draw_hidden
from heartfit.planting.measuring import Study, measured
from heartfit.planting.outsiders import OUTSIDERS

EDV, EJECTION_FRACTION, PEAK = (80e-6, 300e-6), (0.15, 0.80), (8e3, 30e3)
"""What a patient who is examined may have: m^3, 1, Pa."""
PRELOAD = (1.3, 1.6)
"""Resting atrial pressure with the legs raised over that at rest."""
REST, RAISED = "rest", "legs_raised"
ATTEMPTS = 200

T = TypeVar("T")


@dataclass(frozen=True)
class Answer:
    """What was planted, how often a draw was refused and why, and the truth: standard deviates of the parameters."""

    seed: int
    kind: Kind
    effects: tuple[Effect, ...]
    rejected: Mapping[str, int]
    truth: Mapping[str, float]
    volume_noise: float


@dataclass(frozen=True, eq=False)
class PlantedCase:
    """Curves (lv_volume, lv_pressure) by condition, and the answer, which no diagnosis may see."""

    curves: Mapping[str, Mapping[str, Curve]]
    answer: Answer = field(repr=False)


def plant(plan: Plan) -> PlantedCase:
    """The case of this plan; draws that no patient resembles are counted and drawn anew.

    Conditions are "rest" and, where the plan asks for it, "legs_raised". Raises RuntimeError after 200 draws.
    """
    return redrawn(plan.seed, lambda rng, rejected: _planted(plan, rng, rejected))


def redrawn(seed: int, draw: Callable[[np.random.Generator, Mapping[str, int]], T]) -> T:
    """The first draw that is admissible; it is told how many were not, and why. Raises RuntimeError after 200."""
    rejected: Counter[str] = Counter()
    for attempt in range(ATTEMPTS):
        try:
            return draw(np.random.default_rng([seed, attempt]), rejected)
        except Inadmissible as refused:
            rejected[str(refused)] += 1
    raise RuntimeError(f"seed {seed}: {ATTEMPTS} draws were refused, {dict(rejected)}: choose another one")


def _planted(plan: Plan, rng: np.random.Generator, rejected: Mapping[str, int]) -> PlantedCase:
    healthy, study = draw_hidden(rng), Study.draw(rng)
    planted = drawn_effects(plan, rng)
    hidden = healthy.with_effects(planted)
    curves = {REST: _recorded(hidden, study, rng)}
    if plan.reloaded:
        curves[RAISED] = _recorded(hidden.loaded(float(rng.uniform(*PRELOAD))), study, rng)
    require_recordable(curves)
    answer = Answer(
        plan.seed, plan.kind, described(planted, plan.scales), dict(rejected), healthy.deviates, study.noise
    )
    return PlantedCase(curves, answer)


def _recorded(hidden: HiddenHeart, study: Study, rng: np.random.Generator) -> dict[str, Curve]:
    return measured(plausible(hidden.beat(), NUMERICS.drift), hidden.heart.sensors, study, rng)


def require_recordable(curves: Mapping[str, Mapping[str, Curve]]) -> None:
    """Raises Inadmissible for a pressure that no reader takes for one: an offset catheter in a heart that sucks."""
    low, high = PRESSURES
    for recorded in curves.values():
        pressure = recorded["lv_pressure"].values
        if not (low <= pressure.min() and pressure.max() <= high):
            raise Inadmissible("recorded pressure")


def drawn_effects(plan: Plan, rng: np.random.Generator) -> list[Mechanism]:
    """What the plan names, of its size."""
    outside = {cls.__name__: cls for cls in OUTSIDERS}
    known = outside if plan.kind == "outside" else plantable()
    return [draw_effect(known[name], plan.scales, rng) for name in plan.names]


def plausible(beat: Beat, drift: float) -> Beat:
    """The beat; raises Inadmissible with the reason for one that no patient resembles or that drifts more."""
    if not beat.completed:
        raise Inadmissible("no beat")
    if beat.diagnostics["drift"] > drift:
        raise Inadmissible("not periodic")
    volume, pressure = beat.volume["lv"], beat.pressure["lv"]
    seen = {
        "end-diastolic volume": (volume.max(), EDV),
        "ejection fraction": (1.0 - volume.min() / volume.max(), EJECTION_FRACTION),
        "peak pressure": (pressure.max(), PEAK),
    }
    for name, (value, (low, high)) in seen.items():
        if not low <= value <= high:
            raise Inadmissible(name)
    return beat
