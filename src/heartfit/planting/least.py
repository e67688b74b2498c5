"""Which planted effects are large enough to be expected to show."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.diagnosis.limits import limits
from heartfit.planting.effects import Effect
from heartfit.planting.rates import RATES, Rate
from heartfit.planting.scoring import Scored


@dataclass(frozen=True)
class Least:
    """The least sizes that are detected, in scales, by name and sign; infinite where no size that was tried is."""

    scales: Mapping[tuple[str, float], float]

    @classmethod
    def of(cls, scored: Iterable[Scored], threshold: float) -> "Least":
        """Of all single effects that were planted, on the sphere of an average adult."""
        names = {each.answer.effects[0].name for each in scored if each.answer.kind == "single"}
        found = limits(1, names=sorted(names), threshold=threshold) if names else ()
        return cls({(each.name, each.sign): np.inf if each.least is None else each.least for each in found})

    def told(self, name: str) -> str:
        """The least sizes of an effect in words, one for each sign; none of what is outside the library."""
        known = [least for (each, _), least in self.scales.items() if each == name]
        return " or ".join(f"{least:.1f}" if np.isfinite(least) else "not to 4" for least in known)

    def of_effect(self, effect: Effect) -> float:
        """In scales."""
        return self.scales[effect.name, float(np.sign(effect.amplitude - effect.off))]

    def reached(self, each: Scored) -> bool:
        """Whether a case hides one effect of the library, and that is at least so large."""
        if each.answer.kind != "single":
            return False
        (effect,) = each.answer.effects
        return effect.scales >= self.of_effect(effect)

    def rates(self, target: float | None = None) -> tuple[Rate, ...]:
        """All rates, and those of the effects large enough to be expected to show; target: of those named right."""
        return (
            *RATES,
            Rate("singles above their limit, detected", self.reached, lambda each: each.detected),
            Rate("singles above their limit, named right", self.reached, lambda each: each.right, target),
        )
