"""What a study of many subjects comes to."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeVar

from heartfit.planning.footprint import Footprint
from heartfit.planning.need import Need

T = TypeVar("T", Need, Footprint)
LEVELS = ("study", "case", "setting", "point")


@dataclass(frozen=True)
class Subjects:
    """So many of a kind, each under so many settings, with so many sigma points under all of them together."""

    number: int
    kind: str
    settings: int
    points: int

    def times(self, per: str) -> int:
        """How often there is what there is one of for each study, case, setting or point."""
        each = {"study": 0, "case": 1, "setting": self.settings, "point": self.points}[per]
        return self.number * each or 1


@dataclass(frozen=True)
class Part:
    """Jobs, their seconds one after the other, files and megabytes of what there is one of for each `per`."""

    per: str
    jobs: float
    seconds: float
    files: float
    megabytes: float


def forecast(rows: Sequence[Need], prints: Sequence[Footprint], subjects: Subjects) -> list[Part]:
    """By study, case, setting and point; what only some cases have is counted by its share in what was measured."""
    usual = [row for row in rows if row.usual]
    return [_part(per, _of(usual, per, subjects), _of(prints, per, subjects), subjects) for per in LEVELS]


def whole(parts: Sequence[Part]) -> Part:
    """All of them together."""
    sums = [sum(getattr(part, name) for part in parts) for name in ("jobs", "seconds", "files", "megabytes")]
    return Part("all", *sums)


def each(parts: Sequence[Part], subjects: Subjects) -> Part:
    """What a subject adds."""
    own = whole([part for part in parts if part.per != "study"])
    number = subjects.number
    return Part("case", own.jobs / number, own.seconds / number, own.files / number, own.megabytes / number)


def _of(entries: Sequence[T], per: str, subjects: Subjects) -> list[T]:
    kind = "" if per == "study" else subjects.kind
    return [entry for entry in entries if entry.per == per and entry.kind == kind]


def _part(per: str, rows: Sequence[Need], prints: Sequence[Footprint], subjects: Subjects) -> Part:
    often = subjects.times(per)
    return Part(
        per,
        often * sum(row.share for row in rows),
        often * sum(row.share * row.typical_s for row in rows),
        often * sum(each.files for each in prints),
        often * sum(each.megabytes for each in prints),
    )
