"""Writes the tables and configurations of shards, and reads their numbers together."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd
import yaml

from heartfit.errors import InputError
from heartfit.io.atomic import write_text
from heartfit.io.tables import read_numbers
from heartfit.planning.shards import split
from heartfit.tables.joined import joined


def write_shards(
    folder: Path, table: Path, reference: str, size: int, results: str, over: Mapping[str, Any]
) -> list[Path]:
    """A table of cases and a configuration for each shard; the configurations.

    table: all cases; reference: the one that is in every shard; results: folder of the whole study; over: what is laid
    over the study's configuration, of whose sources each shard keeps its own.
    """
    header, *rows = [line for line in table.read_text(encoding="utf-8-sig").splitlines() if line.strip()]
    place = header.split("\t").index("case")
    by_name = {row.split("\t")[place]: row for row in rows}
    if reference not in by_name or len(by_name) < 2:
        raise InputError(
            f"{table}: expected {reference} for every shard, and others: correct sensitivity.case"
        )
    written = []
    for number, names in enumerate(split([*by_name], reference, size)):
        cases, configuration = folder / f"{number:03d}.tsv", folder / f"{number:03d}.yaml"
        write_text(cases, "\n".join([header, *(by_name[name] for name in names)]) + "\n")
        sources = {name: source for name, source in over.get("sources", {}).items() if name in names}
        own = {"cases": cases.as_posix(), "results": f"{results}/shards/{number:03d}", "sources": sources}
        write_text(configuration, yaml.safe_dump({**over, **own}, sort_keys=False))
        written.append(configuration)
    return written


def read_joined(results: Sequence[Path]) -> pd.DataFrame:
    """The numbers of all shards, those of the reference once; raises InputError where they differ."""
    return joined({str(folder): read_numbers(folder / "tables" / "numbers.csv") for folder in results})
