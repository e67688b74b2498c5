"""What studies cost: measured in their results, and kept as tables beside the workflow's resources."""

import csv
import io
from collections.abc import Sequence
from dataclasses import astuple, fields
from pathlib import Path
from typing import TypeVar

from heartfit.errors import InputError
from heartfit.io.atomic import write_text
from heartfit.io.benchmarks import read_benchmarks
from heartfit.planning.footprint import Footprint, footprints
from heartfit.planning.need import SHARED, Cost, Need, needs, virtual_cases

Row = TypeVar("Row", Need, Footprint)
NEEDS, FOOTPRINTS = "costs.tsv", "footprints.tsv"


def write_costs(folder: Path, results: Sequence[Path]) -> None:
    """Both tables of the results of studies, the files of the first of them."""
    write_text(folder / NEEDS, as_table(Need, measured_needs(results)))
    write_text(folder / FOOTPRINTS, as_table(Footprint, measured_footprints(results[0])))


def measured_needs(results: Sequence[Path]) -> list[Need]:
    """What jobs took; of a kind of job that several studies ran, what the first of them says."""
    found: dict[str, Need] = {}
    rows: list[Need] = []
    for folder in results:
        new = [row for row in needs(read_benchmarks(folder / "benchmarks")) if row.job not in found]
        rows += new
        found |= {row.job: row for row in new}
    return sorted(rows, key=lambda row: (row.job, row.per, row.kind))


def measured_footprints(results: Path) -> list[Footprint]:
    """What files a study left."""
    costs = read_benchmarks(results / "benchmarks")
    virtual = virtual_cases(costs)
    cases = {cost.job.split("/")[0] for cost in costs if "/" in cost.job} - {*SHARED}
    kinds = {case: "virtual" if case in virtual else "measured" for case in cases}
    settings = {cost.job.split("/")[1] for cost in costs if _under_a_setting(cost, cases)}
    sizes = [
        (file.relative_to(results).as_posix(), file.stat().st_size)
        for file in sorted(results.rglob("*"))
        if file.is_file()
    ]
    return footprints(sizes, kinds, settings)


def _under_a_setting(cost: Cost, cases: set[str]) -> bool:
    return cost.job.count("/") == 2 and cost.job.split("/")[0] in cases


def as_table(kind: type[Row], rows: Sequence[Row]) -> str:
    """As text, tab separated, numbers to four digits."""
    text = io.StringIO()
    table = csv.writer(text, delimiter="\t", lineterminator="\n")
    table.writerow([entry.name for entry in fields(kind)])
    for row in rows:
        table.writerow([f"{value:.4g}" if isinstance(value, float) else value for value in astuple(row)])
    return text.getvalue()


def read_table(kind: type[Row], path: Path) -> list[Row]:
    """What `as_table` wrote; raises InputError for a file that is none."""
    if not path.is_file():
        raise InputError(f"{path}: no such file; expected measured costs: `heartfit costs` writes them")
    with path.open(newline="", encoding="utf-8") as stream:
        lines = list(csv.DictReader(stream, delimiter="\t"))
    known = [(entry.name, entry.type) for entry in fields(kind)]
    try:
        return [kind(**{name: of(line[name]) for name, of in known if callable(of)}) for line in lines]
    except (KeyError, TypeError, ValueError):
        expected = ", ".join(name for name, _ in known)
        raise InputError(
            f"{path}: not the costs that were measured; expected the columns {expected}: write it anew"
        ) from None
