"""Hidden effects on which the search for causes is scored: how many of each kind, how large, on which seeds."""

from collections.abc import Collection, Iterable
from itertools import chain
from typing import Self

from pydantic import Field, PositiveFloat, model_validator

from heartfit.configuration.fields import MOST, Count, Inside
from heartfit.configuration.generator import Generator
from heartfit.configuration.strict import Strict
from heartfit.planting.campaign import Campaign, Kind, Plan, Reloaded
from heartfit.planting.effects import plantable
from heartfit.planting.outsiders import OUTSIDERS

SCORING = 100000
"""The first seed on which nothing is tuned; tuning keeps below 1000."""


class VentricularBenchmark(Strict):
    """The same in three dimensions: effects hidden in ventricles, searched on a sphere centred on one beat."""

    first_seed: int = Field(
        ge=SCORING, lt=1 << 63, description="of the first case; each further one has the next"
    )
    nulls: Count
    effects: tuple[str, ...] = Field(min_length=1, description="mechanisms that are hidden, by name")
    each: Count = Field(description="cases of each effect")
    outsiders: tuple[str, ...] = Field((), description="effects outside the library, one case each")
    pairs: tuple[tuple[str, str], ...] = Field((), description="two mechanisms in one heart, one case each")
    scales: PositiveFloat = Field(description="size, in scales of the mechanism")
    generator: Generator = Field(description="of the hidden hearts")
    diagnoser: Generator = Field(description="of the one beat on which the sphere is centred")
    setting: str = Field(description="of that beat, at the mean of its prior")
    heart: dict[str, float] = Field({}, description="parameters of that beat that the setting has otherwise")
    page: Inside = Field(description="folder of the page; its figures go into `figures` there")
    claims: str = Field(description="table of what the rates are claimed to be")

    @model_validator(mode="after")
    def _can_be_planted(self) -> Self:
        _require_known((*self.effects, *chain(*self.pairs)), plantable())
        _require_known(self.outsiders, [cls.__name__ for cls in OUTSIDERS])
        return self

    def plans(self) -> list[Plan]:
        """The cases to plant, one a job: nulls, every effect as often as asked for, outsiders and pairs."""
        planted: list[tuple[Kind, tuple[str, ...]]] = [("none", ())] * self.nulls
        planted += [("single", (name,)) for name in self.effects for _ in range(self.each)]
        planted += [("outside", (name,)) for name in self.outsiders]
        planted += [("two", pair) for pair in self.pairs]
        return [
            Plan(seed, kind, names, self.scales if names else 0.0)
            for seed, (kind, names) in enumerate(planted, self.first_seed)
        ]


class ReloadedBenchmark(Strict):
    """Hearts that are searched by volume alone, and with another condition, too."""

    nulls: int = Field(ge=0, le=MOST, description="the first so many")
    singles: int = Field(ge=0, le=MOST, description="the first so many of one size")
    scales: PositiveFloat = Field(description="that size, in scales of the mechanism")


def _require_known(names: Iterable[str], known: Collection[str]) -> None:
    for name in names:
        if name not in known:
            raise ValueError(f"{name!r} cannot be planted; known are {', '.join(known)}")


class DiscoveryBenchmark(Strict):
    """Counts of hidden hearts by kind: a single and an outsider of each effect and size, nulls and pairs in all."""

    first_seed: int = Field(
        ge=SCORING, lt=1 << 63, description="of the first case; each further one has the next"
    )
    nulls: Count
    singles: Count = Field(description="of each mechanism and size")
    scales: tuple[PositiveFloat, ...] = Field(min_length=1, description="sizes, in scales of the mechanism")
    outsiders: Count = Field(description="of each effect outside the library and size")
    pairs: Count
    pair_scales: PositiveFloat
    reloaded: ReloadedBenchmark
    cases: Count | None = Field(None, description="only the first so many, a fair sample of all")
    batch: Count = Field(description="cases of a job")
    page: Inside = Field(description="folder of the page; its figures go into `figures` there")
    claims: str = Field(description="table of what the rates are claimed to be")
    ventricles: VentricularBenchmark

    def batches(self) -> list[list[Plan]]:
        """The cases to plant, job by job."""
        return self._campaign().batches(self.batch, self.cases)

    def planned(self) -> int:
        """The number of all cases, of which the first may be taken."""
        return sum(map(len, self._campaign().batches(self.batch)))

    def _campaign(self) -> Campaign:
        counts = self.nulls, self.singles, self.outsiders, self.pairs
        reloaded = Reloaded(self.reloaded.nulls, self.reloaded.singles, self.reloaded.scales)
        return Campaign(self.first_seed, *counts, self.scales, self.pair_scales, reloaded)
