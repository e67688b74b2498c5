"""Shards of a large study: their tables and configurations, and their numbers read together."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd
import yaml

from heartfit.core.errors import InputError
from heartfit.io.files import write_text
from heartfit.io.tables import read_numbers
from heartfit.study.forecast import split_cases


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


def read_shards(results: Sequence[Path]) -> dict[str, pd.DataFrame]:
    """Read the numbers of each shard by its folder; raises InputError for a folder without numbers."""
    return {str(folder): read_numbers(folder / "tables" / "numbers.csv") for folder in results}
