"""What is planted: mechanisms of the registry, or outsiders, at sizes counted in their own scales."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np

from heartfit.heart import Heart
from heartfit.mechanism import Mechanism, registered
from heartfit.parameter import parameters_of

FURTHEST = 2.0
"""Standard deviations at which the draw of a timing or location is cut off."""


class Inadmissible(ValueError):
    """The draw makes no physical sense, with the reason in a word: it is counted and drawn anew."""


@dataclass(frozen=True)
class Effect:
    """What was planted: amplitude, SI, of a mechanism, where it is off, size in scales, and other parameters."""

    name: str
    amplitude: float
    off: float
    unit: str
    scales: float
    others: Mapping[str, float] = field(default_factory=dict)


def plantable() -> dict[str, type[Mechanism]]:
    """The mechanisms of the registry that say how large they are and are not in every heart anyway, by name."""
    everywhere = {type(each) for each in Heart().mechanisms}
    return {
        name: cls
        for name, cls in registered().items()
        if cls not in everywhere and cls.switch().scale is not None
    }


def draw_effect(cls: type[Mechanism], scales: float, rng: np.random.Generator) -> Mechanism:
    """A mechanism of this size; sign, where it has one, location and timing are drawn from their priors.

    Raises Inadmissible for a draw that the mechanism refuses.
    """
    switch = cls.switch()
    if switch.scale is None:
        raise TypeError(f"{cls.__name__}.{switch.name} declares no scale: it cannot be planted")
    sign = 1.0 if switch.one_sided else float(rng.choice((-1.0, 1.0)))
    drawn = {
        each.name: each.at(float(np.clip(rng.standard_normal(), -FURTHEST, FURTHEST)))
        for each in parameters_of(cls)
        if each.name != switch.name and (each.sd is not None or each.scale is not None)
    }
    try:
        return cls(**drawn, **{switch.name: switch.at(sign * scales)})
    except ValueError:
        raise Inadmissible("refused by the mechanism") from None


def described(mechanisms: Iterable[Mechanism], scales: float) -> tuple[Effect, ...]:
    """The effects that these mechanisms are."""
    return tuple(_described(each, scales) for each in mechanisms)


def _described(planted: Mechanism, scales: float) -> Effect:
    switch, values = planted.switch(), {each.name: each.value for each in parameters_of(planted)}
    amplitude = values.pop(switch.name)
    return Effect(type(planted).__name__, amplitude, switch.off or 0.0, switch.unit, scales, values)
