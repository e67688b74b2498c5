"""Dependence of a ranking on the scales of its effects.

A scale, the standard deviation of an effect's prior, is a judgement, and ln Z depends on it in two ways: a wide prior
is penalised by Occam's factor, a narrow one holds a strong effect back.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from itertools import product

FACTORS = (4.0, 0.25)
"""Factors on the scale of an effect at which a ranking is examined."""


@dataclass(frozen=True)
class ScaleDependence:
    """A finding that depends on a scale: ln Bayes factors of what is found with it, and with ``factor`` times it."""

    name: str
    factor: float
    found: Mapping[str, float]
    changed: Mapping[str, float]

    def __str__(self) -> str:
        return f"{_listed(self.found)}; with {self.factor:g} times this scale {_listed(self.changed)}"


def scale_dependences(
    ranking: Mapping[str, float],
    at_scale: Mapping[str, Callable[[float], float]],
    detected: float,
    apart: float = 0.0,
) -> Iterator[ScaleDependence]:
    """Yield the scales with which other effects would be found.

    ranking: ln Bayes factors by name; at_scale: ln Bayes factor of each effect with its scale times a factor; detected:
    threshold of the best one; apart: lead that the best one needs, without which others are found with it.
    """
    before = _found(ranking, detected, apart)
    for name, factor in product(at_scale, FACTORS):
        changed = at_scale[name](factor)
        if factor < 1.0 and changed < ranking[name]:
            continue  # the data contradict so small a scale
        after = _found({**ranking, name: changed}, detected, apart)
        if after.keys() != before.keys():
            yield ScaleDependence(name, factor, before, after)


def _found(ranking: Mapping[str, float], detected: float, apart: float) -> dict[str, float]:
    best = max(ranking.values())
    return {name: value for name, value in ranking.items() if best >= detected and value >= best - apart}


def _listed(found: Mapping[str, float]) -> str:
    return " or ".join(f"{name} ({value:.1f})" for name, value in found.items()) or "nothing"
