"""Planted case: the measurement of a hidden heart, with the answer kept separate."""

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TypeVar

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.beat import Beat
from heartfit.observation.curve import PRESSURE_RANGE, Curve
from heartfit.roles import Mechanism
from heartfit.synthetic.campaign import (
    Effect,
    Inadmissible,
    Kind,
    PlantedPlan,
    Population,
    draw_effect,
    effects_of,
    plantable,
)
from heartfit.synthetic.hidden import NUMERICS, HiddenHeart, RecordingProtocol, measure_beat
from heartfit.synthetic.misspecified import AS_SEARCHED, Misspecification
from heartfit.synthetic.out_of_library import OUT_OF_LIBRARY

EDV, EJECTION_FRACTION, PEAK = (80e-6, 300e-6), (0.15, 0.80), (8e3, 30e3)
"""Plausible ranges of end-diastolic volume [m^3], ejection fraction [1] and peak pressure [Pa] of a patient; the
fraction is that of either ventricle."""
PRELOAD = (1.3, 1.6)
"""Range of the ratio of the atrial filling pressure with raised legs to that at rest."""
REST, RAISED = "rest", "legs_raised"
ATTEMPTS = 200

T = TypeVar("T")


@dataclass(frozen=True)
class Answer:
    """Planted effects, rejected draws by reason, and the truth: standard deviates of the parameters, volume noise.

    population: of the heart; misspecification: its departure from the assumptions of the search.
    """

    seed: int
    kind: Kind
    effects: tuple[Effect, ...]
    rejected: Mapping[str, int]
    truth: Mapping[str, float]
    volume_noise: float
    population: Population = "as searched"
    misspecification: Misspecification = AS_SEARCHED


@dataclass(frozen=True, eq=False)
class PlantedCase:
    """Curves (lv_volume [m^3], lv_pressure [Pa]) by condition, and the answer, hidden from any diagnosis."""

    curves: Mapping[str, Mapping[str, Curve]]
    answer: Answer = field(repr=False)


def plant(plan: PlantedPlan) -> PlantedCase:
    """Draw the case of a plan; implausible draws are counted and repeated.

    Conditions are "rest" and, in a reloaded plan, "legs_raised". Raises RuntimeError after 200 rejected draws.
    """
    return draw_admissible(plan.seed, lambda rng, rejected: _draw_case(plan, rng, rejected))


def draw_admissible(seed: int, draw: Callable[[np.random.Generator, Mapping[str, int]], T]) -> T:
    """Return the first admissible draw, which receives the counts of rejected ones by reason.

    Raises RuntimeError after 200 rejected draws.
    """
    rejected: Counter[str] = Counter()
    for attempt in range(ATTEMPTS):
        try:
            return draw(np.random.default_rng([seed, attempt]), rejected)
        except Inadmissible as reason:
            rejected[str(reason)] += 1
    raise RuntimeError(
        f"seed {seed}: all {ATTEMPTS} draws were rejected, {dict(rejected)}; choose another seed"
    )


def _draw_case(plan: PlantedPlan, rng: np.random.Generator, rejected: Mapping[str, int]) -> PlantedCase:
    departure = Misspecification.draw(rng) if plan.population == "misspecified" else AS_SEARCHED
    healthy, protocol = departure.draw_heart(rng), departure.draw_protocol(rng)
    planted = draw_effects(plan, rng)
    hidden = healthy.with_effects(planted)
    curves = {REST: _record(hidden, protocol, rng)}
    if plan.reloaded:
        curves[RAISED] = _record(hidden.with_preload(float(rng.uniform(*PRELOAD))), protocol, rng)
    require_recordable(curves)
    answer = Answer(
        plan.seed,
        plan.kind,
        effects_of(planted, plan.scales),
        dict(rejected),
        healthy.deviates,
        protocol.noise,
        plan.population,
        departure,
    )
    return PlantedCase(curves, answer)


def _record(hidden: HiddenHeart, protocol: RecordingProtocol, rng: np.random.Generator) -> dict[str, Curve]:
    return measure_beat(require_plausible(hidden.beat(), NUMERICS.drift), hidden.heart.sensors, protocol, rng)


def require_recordable(curves: Mapping[str, Mapping[str, Curve]]) -> None:
    """Raise Inadmissible for a pressure outside the range that readers accept."""
    low, high = PRESSURE_RANGE
    for recorded in curves.values():
        pressure = recorded["lv_pressure"].values
        if not (low <= pressure.min() and pressure.max() <= high):
            raise Inadmissible("recorded pressure")


def draw_effects(plan: PlantedPlan, rng: np.random.Generator, sides: int = 1) -> list[Mechanism]:
    """Draw the effects that the plan names, of its size, for a heart of so many sides."""
    outside = {cls.__name__: cls for cls in OUT_OF_LIBRARY}
    library = outside if plan.kind == "outside" else plantable(sides)
    return [draw_effect(library[name], plan.scales, rng) for name in plan.names]


def require_plausible(beat: Beat, drift: float) -> Beat:
    """Return the beat; raise Inadmissible with the reason if it is implausible or drifts more than ``drift``."""
    if not beat.completed:
        raise Inadmissible("no beat")
    if beat.diagnostics["drift"] > drift:
        raise Inadmissible("not periodic")
    volume, pressure = beat.volume["lv"], beat.pressure["lv"]
    ranges = {
        "end-diastolic volume": (volume.max(), EDV),
        "ejection fraction": (_ejection_fraction(volume), EJECTION_FRACTION),
        "peak pressure": (pressure.max(), PEAK),
    }
    for name, (value, (low, high)) in ranges.items():
        if not low <= value <= high:
            raise Inadmissible(name)
    return beat


def require_plausible_right(beat: Beat) -> None:
    """Raise Inadmissible for an implausible right ejection fraction, where a search sees the right volume."""
    low, high = EJECTION_FRACTION
    if not low <= _ejection_fraction(beat.volume["rv"]) <= high:
        raise Inadmissible("right ejection fraction")


def _ejection_fraction(volume: Floats) -> float:
    return float(1.0 - volume.min() / volume.max())
