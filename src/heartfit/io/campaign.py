"""Measured costs of jobs and files, and the shards of a large study."""

import csv
import io
from collections.abc import Mapping, Sequence
from dataclasses import astuple, fields
from pathlib import Path
from typing import Any, TypeVar

import yaml

from heartfit.core.errors import InputError
from heartfit.io.files import write_text
from heartfit.study.forecast import Footprint, footprints, split_cases
from heartfit.study.need import SHARED, Cost, Need, needs, virtual_cases

COLUMNS = {"s", "max_rss", "cpu_time"}


def read_benchmarks(folder: Path) -> list[Cost]:
    """Read the costs of all jobs, named by the paths of their benchmark files; raises InputError if there are none."""
    files = sorted(Path(folder).rglob("*.tsv"))
    if not files:
        raise InputError(f"{folder}: no benchmark of a job; expected those of a study: `snakemake --cores 2`")
    return [_read(file, file.relative_to(folder).with_suffix("").as_posix()) for file in files]


def _read(file: Path, job: str) -> Cost:
    with file.open(newline="") as stream:
        row = next(csv.DictReader(stream, delimiter="\t"), {})
    if not set(row) >= COLUMNS:
        raise InputError(
            f"{file}: no benchmark; expected the columns {', '.join(sorted(COLUMNS))}; delete it"
        )
    return Cost(job, float(row["s"]), _sampled(row["cpu_time"]), _sampled(row["max_rss"]))


def _sampled(text: str) -> float:
    """Parse a sampled number; 0 for a job that ended before its first sample."""
    return 0.0 if text in ("NA", "-") else float(text)


Row = TypeVar("Row", Need, Footprint)
NEEDS, FOOTPRINTS = "costs.tsv", "footprints.tsv"


def write_costs(folder: Path, results: Sequence[Path]) -> None:
    """Write the needs of jobs of several studies, and the footprint of the files of the first study."""
    jobs, files = measured_needs(results), measured_footprints(results[0])
    write_text(folder / NEEDS, as_table(Need, jobs))
    write_text(folder / FOOTPRINTS, as_table(Footprint, files))


def measured_needs(results: Sequence[Path]) -> list[Need]:
    """Costs by kind of job; of a kind that several studies ran, the first study counts."""
    rows: list[Need] = []
    for folder in results:
        measured = {row.job for row in rows}
        rows += [row for row in needs(read_benchmarks(folder / "benchmarks")) if row.job not in measured]
    return sorted(rows, key=lambda row: (row.job, row.per, row.kind))


def measured_footprints(results: Path) -> list[Footprint]:
    """Number and size of the files of a study, by kind; without those of other studies within its folder."""
    others = {benchmarks.parent for benchmarks in results.glob("*/benchmarks")}
    costs = read_benchmarks(results / "benchmarks")
    virtual = virtual_cases(costs)
    cases = {cost.job.split("/")[0] for cost in costs if "/" in cost.job} - {*SHARED}
    kinds = {case: "virtual" if case in virtual else "measured" for case in cases}
    settings = {cost.job.split("/")[1] for cost in costs if _under_a_setting(cost, cases)}
    sizes = [
        (file.relative_to(results).as_posix(), file.stat().st_size)
        for file in sorted(results.rglob("*"))
        if file.is_file() and others.isdisjoint(file.parents)
    ]
    return footprints(sizes, kinds, settings)


def _under_a_setting(cost: Cost, cases: set[str]) -> bool:
    return cost.job.count("/") == 2 and cost.job.split("/")[0] in cases


def as_table(kind: type[Row], rows: Sequence[Row]) -> str:
    """Render rows as tab-separated text, numbers to four digits."""
    text = io.StringIO()
    table = csv.writer(text, delimiter="\t", lineterminator="\n")
    table.writerow([entry.name for entry in fields(kind)])
    for row in rows:
        table.writerow([f"{value:.4g}" if isinstance(value, float) else value for value in astuple(row)])
    return text.getvalue()


def read_table(kind: type[Row], path: Path) -> list[Row]:
    """Read a table that `as_table` rendered; raises InputError for a missing file or other columns."""
    if not path.is_file():
        raise InputError(f"{path}: no such file; expected measured costs: `heartfit costs` writes them")
    with path.open(newline="", encoding="utf-8") as stream:
        lines = list(csv.DictReader(stream, delimiter="\t"))
    columns = [(entry.name, entry.type) for entry in fields(kind)]
    try:
        return [
            kind(**{name: parse(line[name]) for name, parse in columns if callable(parse)}) for line in lines
        ]
    except (KeyError, TypeError, ValueError):
        expected = ", ".join(name for name, _ in columns)
        raise InputError(
            f"{path}: not the costs that were measured; expected the columns {expected}: write it anew"
        ) from None


def write_shards(
    folder: Path, table: Path, reference: str, size: int, results: str, over: Mapping[str, Any]
) -> list[Path]:
    """Write a table of cases and a configuration for each shard; returns the configurations.

    table: all cases; reference: the case that belongs to every shard; results: folder of the whole study; over: keys
    over the study's configuration, of whose sources each shard keeps those of its cases.
    """
    header, *rows = [line for line in table.read_text(encoding="utf-8-sig").splitlines() if line.strip()]
    place = header.split("\t").index("case")
    by_name = {row.split("\t")[place]: row for row in rows}
    if reference not in by_name or len(by_name) < 2:
        raise InputError(
            f"{table}: expected {reference} for every shard, and others: correct sensitivity.case"
        )
    written = []
    for number, names in enumerate(split_cases([*by_name], reference, size)):
        cases, configuration = folder / f"{number:03d}.tsv", folder / f"{number:03d}.yaml"
        write_text(cases, "\n".join([header, *(by_name[name] for name in names)]) + "\n")
        sources = {name: source for name, source in over.get("sources", {}).items() if name in names}
        own = {"cases": cases.as_posix(), "results": f"{results}/shards/{number:03d}", "sources": sources}
        write_text(configuration, yaml.safe_dump({**over, **own}, sort_keys=False))
        written.append(configuration)
    return written
