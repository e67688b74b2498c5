"""What Snakemake takes for itself, and how large a graph may be."""

from collections.abc import Callable
from dataclasses import dataclass

SHARE = 0.05
"""Of the time on the wall that may be Snakemake's own."""
LARGEST = 1_000_000


@dataclass(frozen=True)
class OwnTime:
    """CPU seconds of Snakemake's process for a graph of n jobs: start + job n + square n^2."""

    start: float
    job: float
    square: float

    def of(self, jobs: float) -> float:
        """For a graph of so many jobs."""
        return self.start + self.job * jobs + self.square * jobs**2


HERE = OwnTime(start=3.6, job=0.1, square=1.6e-7)
"""What docs/cluster.md tells of, a job started included."""


def largest_shard(jobs: float, seconds: float, cpus: int, own: OwnTime = HERE) -> int:
    """Subjects in one graph, none if even one graph is too slow for so many CPUs.

    jobs and seconds: of a subject; cpus: that work on the graph at once.
    """

    def held(subjects: int) -> bool:
        return own.of(jobs * subjects) * cpus <= SHARE * seconds * subjects

    return _last(held) if any(held(10**power) for power in range(7)) else 0


def _last(held: Callable[[int], bool]) -> int:
    """The largest number for which it holds, if it holds for one stretch of numbers that has a power of ten in it."""
    low = max(10**power for power in range(7) if held(10**power))
    high = low
    while high < LARGEST and held(high):
        low, high = high, 2 * high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if held(middle) else (low, middle)
    return low
