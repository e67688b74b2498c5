"""Hidden effects on which the search for causes is scored: how many of each kind, how large, on which seeds."""

from pydantic import Field, PositiveFloat, PositiveInt

from heartfit.configuration.strict import Strict
from heartfit.planting.campaign import Campaign, Plan

SCORING = 100000
"""The first seed on which nothing is tuned; tuning keeps below 1000."""


class DiscoveryBenchmark(Strict):
    """Counts of hidden hearts by kind: a single and an outsider of each effect and size, nulls and pairs in all."""

    first_seed: int = Field(ge=SCORING, description="of the first case; each further one has the next")
    nulls: PositiveInt
    singles: PositiveInt = Field(description="of each mechanism and size")
    scales: tuple[PositiveFloat, ...] = Field(min_length=1, description="sizes, in scales of the mechanism")
    outsiders: PositiveInt = Field(description="of each effect outside the library and size")
    pairs: PositiveInt
    pair_scales: PositiveFloat
    cases: PositiveInt | None = Field(None, description="only the first so many, a fair sample of all")
    batch: PositiveInt = Field(description="cases of a job")
    page: str = Field(description="folder of the page; its figures go into `figures` there")
    claims: str = Field(description="table of what the rates are claimed to be")

    def batches(self) -> list[list[Plan]]:
        """The cases to plant, job by job."""
        return self._campaign().batches(self.batch, self.cases)

    def planned(self) -> int:
        """The number of all cases, of which the first may be taken."""
        return sum(map(len, self._campaign().batches(self.batch)))

    def _campaign(self) -> Campaign:
        counts = self.nulls, self.singles, self.outsiders, self.pairs
        return Campaign(self.first_seed, *counts, self.scales, self.pair_scales)
