"""Forecast of jobs, time and files of a study of many subjects, and its split into shards."""

import re
from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from heartfit.core.pages import render_page, table_row
from heartfit.study.need import MEASURED_OWN_TIME, OWN_TIME_SHARE, Need, largest_shard


def split_cases(cases: Sequence[str], reference: str, size: int) -> list[list[str]]:
    """Return the case names of each shard: at most ``size``, and the reference case, which every study needs."""
    others = [case for case in cases if case != reference]
    return [[reference, *others[start : start + size]] for start in range(0, len(others), size)]


SIGMA_POINT_FILE = r"[^.].*/calibration/beats/\d+\.json$"
"""Pattern of a sigma point's result file, but not of its checksum, in a folder whose name begins with a dot."""


@dataclass(frozen=True)
class Footprint:
    """Mean number of files and megabytes per ``per`` (study, case, setting or point) of a ``kind`` of subject."""

    per: str
    kind: str
    files: float
    megabytes: float


def footprints(
    sizes: Sequence[tuple[str, int]], kinds: Mapping[str, str], settings: Collection[str]
) -> list[Footprint]:
    """Average the files and megabytes of a study.

    sizes: path below the results and size [bytes] of every file; kinds: kind of subject by case.
    """
    files: Counter[tuple[str, str]] = Counter()
    bytes_of: Counter[tuple[str, str]] = Counter()
    for name, size in sizes:
        unit = unit_of(name, kinds, settings)
        files[unit] += 1
        bytes_of[unit] += size
    cases = Counter(kinds.values())
    points = Counter(kinds[name.split("/")[0]] for name, _ in sizes if re.match(SIGMA_POINT_FILE, name))
    rows = []
    for per, kind in sorted(files):
        number = {
            "study": 1,
            "case": cases[kind],
            "setting": cases[kind] * len(settings),
            "point": points[kind],
        }[per]
        rows.append(Footprint(per, kind, files[per, kind] / number, bytes_of[per, kind] / number / 1e6))
    return rows


def unit_of(name: str, kinds: Mapping[str, str], settings: Collection[str]) -> tuple[str, str]:
    """Return the unit that has one such file (study, case, setting or point) and the kind of subject, from its path."""
    parts = re.split(r"[/_.]", name)
    case = next((part for part in parts if part in kinds), "")
    if not case or parts[0] == "sensitivity":
        return "study", ""
    if re.search(r"/beats/\d+\.|/simulate_point_\d+\.", name):
        return "point", kinds[case]
    return "setting" if any(part in settings for part in parts) else "case", kinds[case]


T = TypeVar("T", Need, Footprint)
LEVELS = ("study", "case", "setting", "point")


@dataclass(frozen=True)
class Subjects:
    """Number of subjects of a kind, settings per subject, and sigma points per subject over all settings."""

    number: int
    kind: str
    settings: int
    points: int

    def times(self, per: str) -> int:
        """Return the number of units ``per`` (study, case, setting or point)."""
        count = {"study": 0, "case": 1, "setting": self.settings, "point": self.points}[per]
        return self.number * count or 1


@dataclass(frozen=True)
class Part:
    """Jobs, total wall time [s], files and megabytes of all units ``per`` (study, case, setting, point or all)."""

    per: str
    jobs: float
    seconds: float
    files: float
    megabytes: float


def forecast(rows: Sequence[Need], prints: Sequence[Footprint], subjects: Subjects) -> list[Part]:
    """Forecast cost by study, case, setting and point; optional parts of cases count with their measured share."""
    usual = [row for row in rows if row.usual]
    return [
        _part(per, _select(usual, per, subjects), _select(prints, per, subjects), subjects) for per in LEVELS
    ]


def total_of(parts: Sequence[Part]) -> Part:
    """Return the sum of all parts."""
    sums = [sum(getattr(part, name) for part in parts) for name in ("jobs", "seconds", "files", "megabytes")]
    return Part("all", *sums)


def chain_seconds(rows: Sequence[Need], kind: str) -> float:
    """Return the time [s] of one job of each kind in turn: no chain of dependent jobs of a study is longer.

    A second iteration of a setting has a chain of its own and is not counted.
    """
    return sum(row.typical_s for row in rows if row.usual and row.kind in ("", kind))


def wall_seconds(seconds: float, chain: float, cpus: int) -> float:
    """Return the longest time [s] on ``cpus`` CPUs, none of which waits while a job is ready.

    .. math:: t = T / m + (1 - 1 / m) c

    with the time T of all jobs on m CPUs and the longest chain c. Source: Graham, SIAM J. Appl. Math. 17 (1969) 416.
    """
    return seconds / cpus + (1.0 - 1.0 / cpus) * chain


def part_per_subject(parts: Sequence[Part], subjects: Subjects) -> Part:
    """Return the cost that one subject adds."""
    marginal = total_of([part for part in parts if part.per != "study"])
    number = subjects.number
    return Part(
        "case",
        marginal.jobs / number,
        marginal.seconds / number,
        marginal.files / number,
        marginal.megabytes / number,
    )


def _select(entries: Sequence[T], per: str, subjects: Subjects) -> list[T]:
    kind = "" if per == "study" else subjects.kind
    return [entry for entry in entries if entry.per == per and entry.kind == kind]


def _part(per: str, rows: Sequence[Need], prints: Sequence[Footprint], subjects: Subjects) -> Part:
    units = subjects.times(per)
    return Part(
        per,
        units * sum(row.share for row in rows),
        units * sum(row.share * row.typical_s for row in rows),
        units * sum(footprint.files for footprint in prints),
        units * sum(footprint.megabytes for footprint in prints),
    )


CPU_COUNTS = (1, 4, 8, 16)
"""Numbers of CPUs for which the largest graph is printed."""


def forecast_page(parts: Sequence[Part], subjects: Subjects, cpus: int) -> str:
    """Render the forecast by study, case, setting and point, its total, and the largest graph by number of CPUs."""
    total, subject = total_of(parts), part_per_subject(parts, subjects)
    return render_page(
        "forecast",
        subjects=subjects,
        table="".join(map(_row, (*parts, total))),
        days=total.seconds / cpus / 86400.0,
        cpus=cpus,
        own_hours=MEASURED_OWN_TIME.seconds(total.jobs) / 3600.0,
        share=OWN_TIME_SHARE,
        graphs={count: largest_shard(subject.jobs, subject.seconds, count) for count in CPU_COUNTS},
    )


def _row(part: Part) -> str:
    hours, gigabytes = part.seconds / 3600.0, part.megabytes / 1000.0
    return table_row(part.per, f"{part.jobs:.0f}", f"{hours:.3g}", f"{part.files:.0f}", f"{gigabytes:.3g}")
