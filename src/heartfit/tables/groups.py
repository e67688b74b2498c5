"""Who is compared with whom, and where their numbers come from."""

from collections.abc import Mapping
from dataclasses import dataclass

DILATED = "lbbb2"
"""The patient with dilated cardiomyopathy, the paper's LBBB case 2."""


@dataclass(frozen=True)
class Groups:
    """Names of the cases: virtual volunteers, measured hearts (healthy too), virtual patients, and measured ones."""

    volunteers: tuple[str, ...]
    measured: tuple[str, ...] = ()
    patients: tuple[str, ...] = ()
    measured_patients: tuple[str, ...] = ()

    @property
    def healthy(self) -> tuple[str, ...]:
        """Everybody the paper's healthy volunteers are compared with."""
        return self.volunteers + self.measured

    @property
    def diseased(self) -> tuple[str, ...]:
        """Everybody the paper's patients are compared with."""
        return self.patients + self.measured_patients

    @property
    def virtual(self) -> tuple[str, ...]:
        """Everybody whose truth is known."""
        return self.volunteers + self.patients

    @property
    def means(self) -> dict[str, tuple[str, ...]]:
        """The groups of healthy hearts that have a mean, by what is added to its name."""
        several = bool(self.measured) and len(self.healthy) > 1
        with_measured = {f" with {', '.join(self.measured)}": self.healthy} if several else {}
        return ({"": self.volunteers} if self.volunteers else {}) | with_measured


@dataclass(frozen=True)
class Origin:
    """The study that numbers come from: its folder of results, groups, and of each case the period (s) and seed."""

    results: str
    groups: Groups
    periods: Mapping[str, float]
    seeds: Mapping[str, int | None]
