"""Stored tables of a study, to which later runs are held, and the machine that made them.

A folder of resources/reference holds the tables as CSV, ``machine.json`` with the processor and the software behind
them, and ``ensemble.csv`` with what rounding moves in them.
"""

import json
import os
import re
import shutil
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
from llvmlite import binding
from threadpoolctl import threadpool_info

from heartfit.core.errors import InputError
from heartfit.io.files import write_text
from heartfit.io.fingerprint import versions
from heartfit.results.cells import Tables
from heartfit.results.drift import StoredTables
from heartfit.results.ensemble import Ensemble

FREE = ("costs", "posteriors", "curves", "drift")
"""Tables that are not held: times, and the values behind the other tables."""
FREE_COLUMNS = ("run", "parameters", "fingerprint")
"""Columns of `numbers` that name files and code, or repeat other rows."""
TIME = "min"
"""Unit of a claim about computing time."""
MACHINE, ENSEMBLE = "machine.json", "ensemble.csv"


def machine() -> dict[str, str]:
    """Return what decides the last digits: software, and the processor as compiled code and libraries see it."""
    simd = np.show_config(mode="dicts")["SIMD Extensions"]
    blas = sorted({str(library.get("architecture", "")) for library in threadpool_info()} - {""})
    return {
        "software": versions(),
        "compiled for": os.environ.get("NUMBA_CPU_NAME") or str(binding.get_host_cpu_name()),
        "linear algebra for": ", ".join(blas),
        "numpy": " ".join((*simd["baseline"], *simd["found"])),
    }


def read_held_tables(folder: Path) -> dict[str, pd.DataFrame]:
    """Read the held tables of a folder as text, without the cells that name code or measure time.

    Raises InputError for a folder without tables.
    """
    files = [file for file in sorted(Path(folder).glob("*.csv")) if file.name != ENSEMBLE]
    if not files:
        raise InputError(f"{folder}: no table; expected the CSV tables of a study: run `snakemake --cores 2`")
    return {file.stem: _held_part(file) for file in files if file.stem not in FREE}


def _held_part(file: Path) -> pd.DataFrame:
    table = pd.read_csv(file, dtype=str, keep_default_na=False, comment="#")
    kept = table.drop(columns=[column for column in FREE_COLUMNS if column in table])
    claims_of_time = kept["unit"] == TIME if {"paper", "unit"} <= {*kept} else pd.Series(False, kept.index)
    return kept[~claims_of_time].reset_index(drop=True)


def read_reference(folder: Path) -> StoredTables:
    """Read stored tables; raises InputError for a folder without them."""
    stated = Path(folder, MACHINE)
    if not stated.is_file():
        raise InputError(
            f"{folder}: no stored tables; expected {MACHINE} with them: store those of a study, "
            "`heartfit drift TABLES FOLDER --renew`"
        )
    tables, made_by = read_held_tables(folder), json.loads(stated.read_text(encoding="utf-8"))
    return StoredTables(tables, made_by, _read_ensemble(Path(folder, ENSEMBLE)))


def _read_ensemble(file: Path) -> Ensemble | None:
    if not file.is_file():
        return None
    with file.open(encoding="utf-8") as stream:
        members, tested = re.findall(r"\d+", stream.readline())
        table = pd.read_csv(stream, dtype=str, keep_default_na=False)
    return Ensemble.from_table(table, int(members), int(tested))


def write_reference(folder: Path, tables: Tables) -> None:
    """Store held tables of a study with the machine that made them; an ensemble of earlier ones is forgotten."""
    shutil.rmtree(folder, ignore_errors=True)
    for name, table in tables.items():
        write_text(Path(folder, f"{name}.csv"), table.to_csv(index=False, lineterminator="\n"))
    write_text(Path(folder, MACHINE), json.dumps(machine(), indent=1) + "\n")


def write_ensemble(folder: Path, members: Sequence[Tables]) -> Ensemble:
    """Store what rounding moves in stored tables, by the tables of runs that differ in it alone, and return it."""
    ensemble = Ensemble.of(read_held_tables(folder), members)
    rows = ensemble.table().to_csv(index=False, float_format="%.7g", lineterminator="\n")
    head = f"# {ensemble.members} runs, {ensemble.tested} numbers\n"
    write_text(Path(folder, ENSEMBLE), head + rows)
    return ensemble
