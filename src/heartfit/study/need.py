"""Measured cost of jobs, and CPU time of Snakemake for a graph of jobs."""

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median

SHARED = ("sensitivity", "registration_error", "templates", "discovery_benchmark", "discovery_ventricles")
"""Folders of stages that run once for all cases."""

OPTIONAL_JOBS = re.compile(
    r"^(plant|diagnose|discovery|check|refit|prove|try_mechanism|compare_(alternatives|attempts|elements)|"
    r"cover_spheres|study_sphere|plot_sobol|draw_volunteer|try$|learn_noise|tabulate_(discovery|noise|registration))"
)
"""Names of optional jobs, which a study runs only on request."""

SNAKEMAKE_MEMORY = 600.0
"""Memory of the two Snakemake processes next to a cluster job, of the job and of its group [MB]; 240 MB per process
were measured."""
MEMORY_MARGIN, TIME_MARGIN = 1.3, 3.0
"""Safety factors over the largest measured memory and the longest measured time."""


@dataclass(frozen=True)
class Cost:
    """Measured cost of a job: wall time [s], sampled CPU time [s] and peak memory [MB]."""

    job: str
    wall: float
    cpu: float
    memory: float


@dataclass(frozen=True)
class Need:
    """Measured cost of one kind of job, per ``per`` (study, case, setting or point) of a ``kind`` of subject.

    number: measured jobs; share: jobs per unit, below one if only some units have the job; typical_s, longest_s:
    median and maximum of the wall time; memory_mb: peak memory.
    """

    job: str
    per: str
    kind: str
    number: int
    share: float
    typical_s: float
    longest_s: float
    memory_mb: float

    @property
    def usual(self) -> bool:
        """True if every study has such jobs."""
        return not OPTIONAL_JOBS.match(self.job)

    def megabytes(self) -> int:
        """Return the memory to request [MB]: margin over the measured peak, plus Snakemake, in whole hundreds."""
        return 100 * math.ceil((MEMORY_MARGIN * self.memory_mb + SNAKEMAKE_MEMORY) / 100.0)

    def minutes(self) -> int:
        """Return the time to request [min]: margin over the longest measured time, plus one minute."""
        return 1 + math.ceil(TIME_MARGIN * self.longest_s / 60.0)


def needs(costs: Sequence[Cost]) -> list[Need]:
    """Summarise the costs of a study by kind of job, sorted by name."""
    virtual = virtual_cases(costs)
    grouped: dict[tuple[str, str, str], list[Cost]] = {}
    for cost in costs:
        grouped.setdefault(_kind(cost.job, virtual), []).append(cost)
    units: dict[tuple[str, str], int] = {}
    for (_, per, kind), jobs in grouped.items():
        units[per, kind] = max(len(jobs), units.get((per, kind), 1))
    return [
        _need(key, jobs, 1 if key[1] == "study" else units[key[1:]]) for key, jobs in sorted(grouped.items())
    ]


def virtual_cases(costs: Sequence[Cost]) -> set[str]:
    """Return the names of generated (not measured) cases."""
    return {cost.job.split("/")[0] for cost in costs if cost.job.endswith("/generate_volunteer")}


def largest(rows: Sequence[Need], job: str) -> Need:
    """Return the largest need of the jobs of this name over all subjects; raise KeyError if none was measured."""
    named = [row for row in rows if row.job == job]
    if not named:
        raise KeyError(f"{job} was never measured")
    number = sum(row.number for row in named)
    longest, memory = max(row.longest_s for row in named), max(row.memory_mb for row in named)
    return Need(job, "", "", number, 1.0, max(row.typical_s for row in named), longest, memory)


def _kind(job: str, virtual: set[str]) -> tuple[str, str, str]:
    """Return name, unit and kind of subject of a job, from the path of its benchmark."""
    *folders, last = job.split("/")
    name = re.sub(r"_(\d+|[A-Z]\w*)$", "", last)
    if not folders or folders[0] in SHARED:
        return ("build_template" if folders[:1] == ["templates"] else name), "study", ""
    per = "point" if name == "simulate_point" else "case" if len(folders) == 1 else "setting"
    return name, per, "virtual" if folders[0] in virtual else "measured"


def _need(key: tuple[str, str, str], costs: Sequence[Cost], units: int) -> Need:
    walls = [cost.wall for cost in costs]
    memory = max(cost.memory for cost in costs)
    return Need(*key, len(costs), len(costs) / units, median(walls), max(walls), memory)


OWN_TIME_SHARE = 0.05
"""Largest acceptable share of Snakemake's CPU time in the wall time."""
MOST_SUBJECTS = 1_000_000
"""Upper limit of the search for the largest shard."""


@dataclass(frozen=True)
class OwnTime:
    """CPU seconds of Snakemake's process for a graph of n jobs: start + job n + square n^2."""

    start: float
    job: float
    square: float

    def seconds(self, jobs: float) -> float:
        """Return the CPU time for a graph of ``jobs`` jobs [s]."""
        return self.start + self.job * jobs + self.square * jobs**2


MEASURED_OWN_TIME = OwnTime(start=3.6, job=0.1, square=1.6e-7)
"""Measured values, including the start of a job; see docs/cluster.md."""


def largest_shard(jobs: float, seconds: float, cpus: int, own: OwnTime = MEASURED_OWN_TIME) -> int:
    """Return the largest number of subjects in one graph, 0 if no graph is fast enough for so many CPUs.

    jobs, seconds: per subject; cpus: number that work on the graph in parallel.
    """

    def affordable(subjects: int) -> bool:
        return own.seconds(jobs * subjects) * cpus <= OWN_TIME_SHARE * seconds * subjects

    return _largest_true(affordable) if any(affordable(10**power) for power in range(7)) else 0


def _largest_true(condition: Callable[[int], bool]) -> int:
    """Return the largest number that meets the condition, which must hold on one interval with a power of ten in it."""
    low = max(10**power for power in range(7) if condition(10**power))
    high = low
    while high < MOST_SUBJECTS and condition(high):
        low, high = high, 2 * high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if condition(middle) else (low, middle)
    return low
