"""Which cases a benchmark plants: kinds in fixed numbers, shuffled, so that any first part of it is a fair sample."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import Literal

import numpy as np

from heartfit.planting.effects import plantable
from heartfit.planting.outsiders import OUTSIDERS

Kind = Literal["none", "single", "two", "outside"]


@dataclass(frozen=True)
class Plan:
    """What to plant: nothing, one or two mechanisms of the registry or an outsider, by name, of ``scales`` each.

    reloaded: whether the heart is measured with the legs raised too.
    """

    seed: int
    kind: Kind
    names: tuple[str, ...] = ()
    scales: float = 0.0
    reloaded: bool = False


@dataclass(frozen=True)
class Reloaded:
    """Which hearts are measured with the legs raised too: the first nulls, and the first singles of one size."""

    nulls: int = 0
    singles: int = 0
    scales: float = 2.0

    def of(self, plans: Sequence[Plan]) -> list[Plan]:
        """All plans, these marked."""
        nulls = [each for each in plans if each.kind == "none"]
        singles = [each for each in plans if each.kind == "single" and each.scales == self.scales]
        marked = {*nulls[: self.nulls], *singles[: self.singles]}
        return [replace(each, reloaded=each in marked) for each in plans]


@dataclass(frozen=True)
class Campaign:
    """How many of each kind: nulls and pairs in all, singles and outsiders of each effect and size.

    ``first_seed`` is the seed of the first case; each further one has the next. ``pair_scales`` is the size of both
    effects of a pair.
    """

    first_seed: int
    nulls: int
    singles: int
    outsiders: int
    pairs: int
    scales: Sequence[float]
    pair_scales: float
    reloaded: Reloaded = Reloaded()

    def batches(self, size: int, first: int | None = None) -> list[list[Plan]]:
        """The first cases, or all, with the library and the outsiders of this version, ``size`` at a time."""
        plans = self.plans(list(plantable()), [cls.__name__ for cls in OUTSIDERS])[:first]
        return [plans[start : start + size] for start in range(0, len(plans), size)]

    def plans(self, library: Sequence[str], outside: Sequence[str]) -> list[Plan]:
        """All cases, given the names of the library's mechanisms and of the outsiders."""
        rng = np.random.default_rng(self.first_seed)
        kinds = [Plan(0, "none")] * self.nulls
        sizes = list(self.scales)
        kinds += [Plan(0, "single", (name,), s) for name, s in product(library, sizes)] * self.singles
        kinds += [Plan(0, "outside", (name,), s) for name, s in product(outside, sizes)] * self.outsiders
        kinds += [self._pair(library, rng) for _ in range(self.pairs)]
        order = rng.permutation(len(kinds)).tolist()
        return self.reloaded.of(
            [replace(kinds[i], seed=self.first_seed + seed) for seed, i in enumerate(order)]
        )

    def _pair(self, library: Sequence[str], rng: np.random.Generator) -> Plan:
        first, second = rng.choice(sorted(library), 2, replace=False).tolist()
        return Plan(0, "two", (first, second), self.pair_scales)
