"""Configuration of the search for missing effects, and of the benchmark that scores it."""

from collections.abc import Collection, Iterable
from itertools import chain
from typing import Self

from pydantic import Field, PositiveFloat, field_validator, model_validator

from heartfit.core.validation import LARGEST_COUNT, Count, RelativeFolder, Seed, Strict
from heartfit.personalise.numerics import Generator
from heartfit.personalise.setting import Element, compose_heart
from heartfit.synthetic.campaign import (
    Kind,
    PlantedPlan,
    PlantingCampaign,
    Reloaded,
    in_batches,
    misspecified_plans,
    plantable,
)
from heartfit.synthetic.out_of_library import OUT_OF_LIBRARY


class ElementQuestion(Strict):
    """Comparison of two elements: models that may explain a heart of the other element, on the generator's mesh."""

    setting: str = Field(default="locking", description="setting of the calibrator")
    element: Element = Field(
        default="mixed", description="element of the hidden heart and of the competing model"
    )
    mechanism: str = Field(
        default="MitralRegurgitation", description="mechanism of the other competing model"
    )
    period: PositiveFloat = Field(default=0.9, description="s")
    seed: Seed = Field(default=1, description="seed of the measurement errors")

    @field_validator("mechanism")
    @classmethod
    def _mechanism_is_known(cls, name: str) -> str:
        return _require_mechanisms((name,))[0]


class Discovery(Strict):
    """Cases to search on the sphere, and cases to refit and prove in three dimensions."""

    settings: tuple[str, ...] = Field(
        default=(), description="settings whose cases are searched, about ten seconds per case"
    )
    cases: tuple[str, ...] | None = Field(
        default=None,
        description="cases that are refitted and proved, 80 to 200 beats per case; "
        "by default the sealed ones, and measured ones with a recorded pressure",
    )
    walls: tuple[str, ...] = Field(
        default=(),
        description="cases that are also searched with the strain of their wall, 60 to 120 beats per case and setting",
    )
    coarse: Generator | None = Field(
        default=None,
        description="mesh and numerics of the refits, and of sealed cases throughout; those of the study by default",
    )
    generator: Generator | None = Field(
        default=None,
        description="mesh and numerics of the hidden hearts of sealed cases; the cohort's by default",
    )
    trials: tuple[str, ...] = Field(
        default=(),
        description="mechanisms tried on these cases whatever the search names, 10 to 20 beats per trial "
        "and one for each unknown",
    )
    most_steps: Count = Field(default=20, description="most steps of a refit, which may converge earlier")

    element: ElementQuestion = ElementQuestion()

    @field_validator("trials")
    @classmethod
    def _trials_are_known(cls, names: tuple[str, ...]) -> tuple[str, ...]:
        return _require_mechanisms(names)


def _require_mechanisms(names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the names; raise ValueError for a name that is no mechanism."""
    try:
        compose_heart(names)
    except KeyError as unknown:
        raise ValueError(str(unknown.args[0])) from None
    return names


SCORING = 100000
"""First seed reserved for scoring; tuning uses seeds below 1000."""


class VentricularBenchmark(Strict):
    """Benchmark in three dimensions: effects hidden in ventricles, searched on a sphere centred on one beat."""

    first_seed: int = Field(
        ge=SCORING, lt=1 << 63, description="seed of the first case; it grows by one from case to case"
    )
    nulls: Count
    effects: tuple[str, ...] = Field(min_length=1, description="names of the hidden mechanisms")
    each: Count = Field(description="number of cases per effect")
    outsiders: tuple[str, ...] = Field((), description="out-of-library effects, one case per effect")
    pairs: tuple[tuple[str, str], ...] = Field(
        (), description="pairs of mechanisms in one heart, one case per pair"
    )
    scales: PositiveFloat = Field(description="size of the effects, in scales of the mechanism")
    generator: Generator = Field(description="mesh and numerics of the hidden hearts")
    diagnoser: Generator = Field(description="mesh and numerics of the beat on which the sphere is centred")
    setting: str = Field(description="setting of that beat, which is simulated at the mean of its prior")
    heart: dict[str, float] = Field({}, description="parameters of that beat that differ from the setting")
    page: RelativeFolder = Field(
        description="folder of the stored tables, in `measured`, and of the figures, in `figures`"
    )
    claims: str = Field(description="table of the claimed rates")

    @model_validator(mode="after")
    def _can_be_planted(self) -> Self:
        _require_known((*self.effects, *chain(*self.pairs)), plantable())
        _require_known(self.outsiders, [cls.__name__ for cls in OUT_OF_LIBRARY])
        return self

    def plans(self) -> list[PlantedPlan]:
        """Return the planted cases, one per job: nulls, singles, out-of-library effects and pairs."""
        planted: list[tuple[Kind, tuple[str, ...]]] = [("none", ())] * self.nulls
        planted += [("single", (name,)) for name in self.effects for _ in range(self.each)]
        planted += [("outside", (name,)) for name in self.outsiders]
        planted += [("two", pair) for pair in self.pairs]
        return [
            PlantedPlan(seed, kind, names, self.scales if names else 0.0)
            for seed, (kind, names) in enumerate(planted, self.first_seed)
        ]


class ReloadedBenchmark(Strict):
    """Numbers of hearts that are also searched by volume alone and with raised legs."""

    nulls: int = Field(ge=0, le=LARGEST_COUNT, description="number of nulls, the first ones")
    singles: int = Field(ge=0, le=LARGEST_COUNT, description="number of singles of one size, the first ones")
    scales: PositiveFloat = Field(description="size of these singles, in scales of the mechanism")


class MisspecifiedBenchmark(Strict):
    """Hearts about other centres than those of the search, recorded with other errors and an earlier R wave."""

    first_seed: int = Field(
        ge=SCORING, lt=1 << 63, description="seed of the first case; it grows by one from case to case"
    )
    nulls: int = Field(ge=0, le=LARGEST_COUNT)
    singles: int = Field(ge=0, le=LARGEST_COUNT, description="number of cases per mechanism")
    scales: PositiveFloat = Field(description="size of the effects, in scales of the mechanism")

    def plans(self) -> list[PlantedPlan]:
        """Return the planted cases: nulls, then singles."""
        return misspecified_plans(self.first_seed, self.nulls, self.singles, self.scales, plantable())


def _require_known(names: Iterable[str], known: Collection[str]) -> None:
    for name in names:
        if name not in known:
            raise ValueError(f"{name!r} cannot be planted; expected one of {', '.join(known)}")


class DiscoveryBenchmark(Strict):
    """Numbers of hidden hearts: nulls and pairs in all, singles and out-of-library effects per effect and size."""

    first_seed: int = Field(
        ge=SCORING, lt=1 << 63, description="seed of the first case; it grows by one from case to case"
    )
    nulls: Count
    singles: Count = Field(description="number of cases per mechanism and size")
    scales: tuple[PositiveFloat, ...] = Field(min_length=1, description="sizes, in scales of the mechanism")
    outsiders: Count = Field(description="number of cases per out-of-library effect and size")
    pairs: Count
    pair_scales: PositiveFloat
    reloaded: ReloadedBenchmark
    misspecified: MisspecifiedBenchmark
    cases: Count | None = Field(
        None,
        description="number of cases as searched to run, a random sample of all",
    )
    batch: Count = Field(description="number of cases per job")
    page: RelativeFolder = Field(
        description="folder of the stored tables, in `measured`, and of the figures, in `figures`"
    )
    claims: str = Field(description="table of the claimed rates")
    ventricles: VentricularBenchmark

    def batches(self) -> list[list[PlantedPlan]]:
        """Return the planted cases of each job: those as searched, then the misspecified ones."""
        as_searched = self._campaign().batches(self.batch, self.cases)
        return [*as_searched, *in_batches(self.misspecified.plans(), self.batch)]

    def planned(self) -> int:
        """Return the number of all cases as searched, before a limit to the first ones."""
        return sum(map(len, self._campaign().batches(self.batch)))

    def _campaign(self) -> PlantingCampaign:
        counts = self.nulls, self.singles, self.outsiders, self.pairs
        reloaded = Reloaded(self.reloaded.nulls, self.reloaded.singles, self.reloaded.scales)
        return PlantingCampaign(self.first_seed, *counts, self.scales, self.pair_scales, reloaded)
