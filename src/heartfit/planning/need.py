"""What a kind of job needs, from what its jobs took."""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

SHARED = ("sensitivity", "registration_error", "templates", "discovery_benchmark", "discovery_ventricles")
"""Folders of what is done once for all cases."""

ASKED_FOR = re.compile(
    r"^(plant|diagnose|discovery|check|refit|prove|try_mechanism|compare_(attempts|elements)|tabulate_discovery)"
)
"""Names of jobs that a study runs only when it is asked to."""

SNAKEMAKE = 600.0
"""MB of the two Snakemakes beside a job of a cluster: that of the job and that of its group, 240 MB each here."""
ROOM, PATIENCE = 1.3, 3.0
"""Over the largest memory and the longest time that were seen."""


@dataclass(frozen=True)
class Cost:
    """A job by its name: time on the wall, CPU time as sampled, s, and the most memory it held, MB."""

    job: str
    wall: float
    cpu: float
    memory: float


@dataclass(frozen=True)
class Need:
    """A kind of job and what of it: one for each `per` (study, case, setting or point) of a `kind` of subject.

    number: how many were seen; share: how many for each, below one where only some have it; typical_s and longest_s:
    median and largest time on the wall; memory_mb: the most held.
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
        """Whether every study has such jobs."""
        return not ASKED_FOR.match(self.job)

    def megabytes(self) -> int:
        """To ask for: room over the largest seen, and the Snakemakes beside it; whole hundreds."""
        return 100 * math.ceil((ROOM * self.memory_mb + SNAKEMAKE) / 100.0)

    def minutes(self) -> int:
        """To ask for: patience over the longest seen, and one to begin with."""
        return 1 + math.ceil(PATIENCE * self.longest_s / 60.0)


def needs(costs: Sequence[Cost]) -> list[Need]:
    """One for each kind of job of a study, by name."""
    virtual = virtual_cases(costs)
    seen: dict[tuple[str, str, str], list[Cost]] = {}
    for cost in costs:
        seen.setdefault(_kind(cost.job, virtual), []).append(cost)
    units: dict[tuple[str, str], int] = {}
    for (_, per, kind), jobs in seen.items():
        units[per, kind] = max(len(jobs), units.get((per, kind), 1))
    return [
        _need(key, jobs, 1 if key[1] == "study" else units[key[1:]]) for key, jobs in sorted(seen.items())
    ]


def virtual_cases(costs: Sequence[Cost]) -> set[str]:
    """Cases that were generated rather than measured."""
    return {cost.job.split("/")[0] for cost in costs if cost.job.endswith("/generate_volunteer")}


def largest(rows: Sequence[Need], job: str) -> Need:
    """What the jobs of this name need of whatever subject; raises KeyError for one that was never measured."""
    named = [row for row in rows if row.job == job]
    if not named:
        raise KeyError(f"{job} was never measured")
    number = sum(row.number for row in named)
    longest, memory = max(row.longest_s for row in named), max(row.memory_mb for row in named)
    return Need(job, "", "", number, 1.0, max(row.typical_s for row in named), longest, memory)


def _kind(job: str, virtual: set[str]) -> tuple[str, str, str]:
    """Name, of what there is one, and kind of subject, from the place of its benchmark."""
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
