"""Planted effects and the plan of a planting campaign."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from typing import Literal

import numpy as np

from heartfit.core.parameter import parameters_of
from heartfit.heart.heart import Heart
from heartfit.roles import Mechanism, registered
from heartfit.roles.sides import acts_within
from heartfit.synthetic.out_of_library import OUT_OF_LIBRARY

DRAWN = "drawn"
"""Word in place of a mechanism's name: the seed draws the mechanism and its size."""
TRUNCATION = 2.0
"""Truncation of the draws of timing and location [standard deviations]."""


class Inadmissible(ValueError):
    """Rejected draw; the message is the reason under which it is counted before the heart is drawn anew."""


@dataclass(frozen=True)
class Effect:
    """Planted mechanism: amplitude and off value [unit], size [scales of the mechanism], and other parameters [SI]."""

    name: str
    amplitude: float
    off: float
    unit: str
    scales: float
    others: Mapping[str, float] = field(default_factory=dict)


def plantable(sides: int = 1) -> dict[str, type[Mechanism]]:
    """Registered mechanisms of a heart of so many sides, by name, that declare a scale and are not in every heart."""
    everywhere = {type(mechanism) for mechanism in Heart().mechanisms}
    return {
        name: cls
        for name, cls in registered().items()
        if cls not in everywhere and cls.switch().scale is not None and acts_within(cls, sides)
    }


def draw_effect(cls: type[Mechanism], scales: float, rng: np.random.Generator) -> Mechanism:
    """Draw a mechanism of the size ``scales``; a two-sided sign, location and timing follow their priors.

    Raises Inadmissible for a draw that the mechanism refuses, TypeError for a mechanism without a scale.
    """
    switch = cls.switch()
    if switch.scale is None:
        raise TypeError(
            f"{cls.__name__}.{switch.name} declares no scale; expected one: declare `scale` to plant it"
        )
    sign = 1.0 if switch.one_sided else float(rng.choice((-1.0, 1.0)))
    drawn = {
        parameter.name: parameter.at(float(np.clip(rng.standard_normal(), -TRUNCATION, TRUNCATION)))
        for parameter in parameters_of(cls)
        if parameter.name != switch.name and (parameter.sd is not None or parameter.scale is not None)
    }
    try:
        return cls(**drawn, **{switch.name: switch.at(sign * scales)})
    except ValueError:
        raise Inadmissible("refused by the mechanism") from None


def effects_of(mechanisms: Iterable[Mechanism], scales: float) -> tuple[Effect, ...]:
    """Return the record of each mechanism as an effect of the size ``scales``."""
    return tuple(_effect_of(mechanism, scales) for mechanism in mechanisms)


def _effect_of(planted: Mechanism, scales: float) -> Effect:
    switch = planted.switch()
    values = {parameter.name: parameter.value for parameter in parameters_of(planted)}
    amplitude = values.pop(switch.name)
    return Effect(type(planted).__name__, amplitude, switch.off or 0.0, switch.unit, scales, values)


def mechanism_of(effect: Effect) -> Mechanism:
    """Return the registered mechanism of an effect's name with its values."""
    kind = registered()[effect.name]
    return kind(**{kind.switch().name: effect.amplitude}, **effect.others)


Kind = Literal["none", "single", "two", "outside"]
Population = Literal["as searched", "misspecified"]
"""Hearts that scatter as the search assumes, and hearts about other centres, recorded with other errors."""


@dataclass(frozen=True)
class PlantedPlan:
    """Plan of a planted case: no effect, one or two registered mechanisms, or one out-of-library effect, by name.

    scales: size of each effect in scales of its mechanism; reloaded: the heart is also measured with raised legs;
    population: of the hidden heart and of the errors of its recording.
    """

    seed: int
    kind: Kind
    names: tuple[str, ...] = ()
    scales: float = 0.0
    reloaded: bool = False
    population: Population = "as searched"


def misspecified_plans(
    first_seed: int, nulls: int, singles: int, scales: float, library: Iterable[str]
) -> list[PlantedPlan]:
    """Return plans of the misspecified population: nulls, then ``singles`` cases of every mechanism of the library.

    ``first_seed`` is the seed of the first case and grows by one from case to case.
    """
    sound: list[PlantedPlan] = [PlantedPlan(0, "none", population="misspecified")] * nulls
    ill = [PlantedPlan(0, "single", (name,), scales, population="misspecified") for name in library] * singles
    return [replace(plan, seed=seed) for seed, plan in enumerate(sound + ill, first_seed)]


def in_batches(plans: Sequence[PlantedPlan], size: int) -> list[list[PlantedPlan]]:
    """Return the plans in batches of ``size``; the last one may be smaller."""
    return [list(plans[start : start + size]) for start in range(0, len(plans), size)]


@dataclass(frozen=True)
class Reloaded:
    """Numbers of nulls, and of singles of one size, that are also measured with raised legs: the first of each."""

    nulls: int = 0
    singles: int = 0
    scales: float = 2.0

    def mark(self, plans: Sequence[PlantedPlan]) -> list[PlantedPlan]:
        """Return all plans; the selected ones have ``reloaded`` set."""
        nulls = [plan for plan in plans if plan.kind == "none"]
        singles = [plan for plan in plans if plan.kind == "single" and plan.scales == self.scales]
        marked = {*nulls[: self.nulls], *singles[: self.singles]}
        return [replace(plan, reloaded=plan in marked) for plan in plans]


@dataclass(frozen=True)
class PlantingCampaign:
    """Numbers of cases by kind: nulls and pairs in all, singles and out-of-library effects per effect and size.

    ``first_seed`` is the seed of the first case and grows by one from case to case. ``pair_scales`` is the size of
    both effects of a pair.
    """

    first_seed: int
    nulls: int
    singles: int
    out_of_library: int
    pairs: int
    scales: Sequence[float]
    pair_scales: float
    reloaded: Reloaded = Reloaded()

    def batches(self, size: int, first: int | None = None) -> list[list[PlantedPlan]]:
        """Return the plans, or only the ``first`` ones, in batches of ``size``, for the effects of this version."""
        plans = self.plans(list(plantable()), [cls.__name__ for cls in OUT_OF_LIBRARY])
        return in_batches(plans[:first], size)

    def plans(self, library: Sequence[str], outside: Sequence[str]) -> list[PlantedPlan]:
        """Return all plans in random order, for mechanisms of the library and effects outside it, by name."""
        rng = np.random.default_rng(self.first_seed)
        kinds = [PlantedPlan(0, "none")] * self.nulls
        sizes = list(self.scales)
        kinds += [PlantedPlan(0, "single", (name,), s) for name, s in product(library, sizes)] * self.singles
        kinds += [
            PlantedPlan(0, "outside", (name,), s) for name, s in product(outside, sizes)
        ] * self.out_of_library
        kinds += [self._pair(library, rng) for _ in range(self.pairs)]
        order = rng.permutation(len(kinds)).tolist()
        return self.reloaded.mark(
            [replace(kinds[i], seed=self.first_seed + seed) for seed, i in enumerate(order)]
        )

    def _pair(self, library: Sequence[str], rng: np.random.Generator) -> PlantedPlan:
        first, second = rng.choice(sorted(library), 2, replace=False).tolist()
        return PlantedPlan(0, "two", (first, second), self.pair_scales)
