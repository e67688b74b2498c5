"""Hidden effects on which the search for causes is scored: how many of each kind, how large, on which seeds."""

from itertools import count

from pydantic import Field, NonNegativeInt, PositiveFloat, PositiveInt, field_validator

from heartfit.configuration.generator import Generator
from heartfit.configuration.strict import Strict
from heartfit.planting.campaign import Campaign, Plan, Reloaded
from heartfit.planting.effects import plantable

SCORING = 100000
"""The first seed on which nothing is tuned; tuning keeps below 1000."""


class VentricularBenchmark(Strict):
    """The same in three dimensions: effects hidden in ventricles, searched on a sphere centred on one beat."""

    first_seed: int = Field(ge=SCORING, description="of the first case; each further one has the next")
    nulls: PositiveInt
    effects: tuple[str, ...] = Field(min_length=1, description="mechanisms that are hidden, by name")
    each: PositiveInt = Field(description="cases of each effect")
    scales: PositiveFloat = Field(description="size, in scales of the mechanism")
    generator: Generator = Field(description="of the hidden hearts")
    diagnoser: Generator = Field(description="of the one beat on which the sphere is centred")
    setting: str = Field(description="of that beat, at the mean of its prior")
    heart: dict[str, float] = Field({}, description="parameters of that beat that the setting has otherwise")
    page: str = Field(description="folder of the page; its figures go into `figures` there")
    claims: str = Field(description="table of what the rates are claimed to be")

    @field_validator("effects")
    @classmethod
    def _can_be_planted(cls, effects: tuple[str, ...]) -> tuple[str, ...]:
        known = plantable()
        for name in effects:
            if name not in known:
                raise ValueError(f"{name!r} cannot be planted; known are {', '.join(known)}")
        return effects

    def plans(self) -> list[Plan]:
        """The cases to plant, one a job: nulls, then every effect, each as often as asked for."""
        seeds = count(self.first_seed)
        planted = [None] * self.nulls + [name for name in self.effects for _ in range(self.each)]
        return [
            Plan(seed, "none") if name is None else Plan(seed, "single", (name,), self.scales)
            for seed, name in zip(seeds, planted, strict=False)
        ]


class ReloadedBenchmark(Strict):
    """Hearts that are searched by volume alone, and with another condition, too."""

    nulls: NonNegativeInt = Field(description="the first so many")
    singles: NonNegativeInt = Field(description="the first so many of one size")
    scales: PositiveFloat = Field(description="that size, in scales of the mechanism")


class DiscoveryBenchmark(Strict):
    """Counts of hidden hearts by kind: a single and an outsider of each effect and size, nulls and pairs in all."""

    first_seed: int = Field(ge=SCORING, description="of the first case; each further one has the next")
    nulls: PositiveInt
    singles: PositiveInt = Field(description="of each mechanism and size")
    scales: tuple[PositiveFloat, ...] = Field(min_length=1, description="sizes, in scales of the mechanism")
    outsiders: PositiveInt = Field(description="of each effect outside the library and size")
    pairs: PositiveInt
    pair_scales: PositiveFloat
    reloaded: ReloadedBenchmark
    cases: PositiveInt | None = Field(None, description="only the first so many, a fair sample of all")
    batch: PositiveInt = Field(description="cases of a job")
    page: str = Field(description="folder of the page; its figures go into `figures` there")
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
