"""Numerical error of every number of a study, from an ensemble: python -m benchmarks.ensemble NAME MEMBERS [--store]

NAME: a folder of resources/reference. Each member is a run whose jobs read positions moved by 1e-12 of themselves and
voxels by one unit in the last place; two more are unmoved, with the arithmetic of older processors. Two members run at
a time, those that have ended are kept in results/ensemble, and docs/measured/ensemble.tsv says how many digits hold.
Means, deviations and words are stored with the tables, and from then on judge other runs, once each member, left out,
agrees with the others. With --store no member is run.
"""

import os
import shutil
import subprocess
import sys
from collections import Counter
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from math import inf
from pathlib import Path

import pandas as pd

from benchmarks.measured_table import read_table, store_table
from benchmarks.ventricles import ROOT
from heartfit.core.errors import InputError
from heartfit.io.reference import ENSEMBLE, read_held_tables, write_ensemble
from heartfit.results.cells import Move, Tables
from heartfit.results.ensemble import MOST_DIGITS, UNHELD, Ensemble, leave_one_out

MODULE, TABLE = "benchmarks.ensemble", "ensemble"
CONFIGURATIONS = {
    "study": ("config/config.yaml",),
    "measured_heart": ("config/measured_heart.yaml",),
    "smoke": ("config/smoke.yaml",),
    "measured_heart_smoke": ("config/measured_heart.yaml", "config/measured_heart_smoke.yaml"),
}
REFERENCE, RESULTS = Path("resources/reference"), Path("results/ensemble")
WIDEST = "X86_V4 AVX512_ICL AVX512_SPR"
PROCESSORS = {
    "haswell": {
        "OPENBLAS_CORETYPE": "Haswell",
        "NUMBA_CPU_NAME": "haswell",
        "NPY_DISABLE_CPU_FEATURES": WIDEST,
    },
    "nehalem": {
        "OPENBLAS_CORETYPE": "Nehalem",
        "NUMBA_CPU_NAME": "x86-64",
        "NPY_DISABLE_CPU_FEATURES": f"X86_V3 {WIDEST}",
    },
}
"""Settings of the libraries that give the arithmetic of an older processor: with AVX2 and FMA, and without."""
RUN = (sys.executable, "-m", "snakemake", "--cores", "1", "--scheduler", "greedy")


def main(name: str, count: int, store: bool) -> None:
    """Run the members that are missing, two at a time, and store the ensemble; ``store``: of those that there are."""
    names = [*PROCESSORS, *map(str, range(1, count + 1))]
    if not store:
        with ThreadPoolExecutor(2) as pool:
            list(pool.map(lambda member: run(name, member), names))
    folders = {member: RESULTS / name / member for member in names}
    members = {member: read_held_tables(folder) for member, folder in folders.items() if folder.is_dir()}
    stored = read_held_tables(REFERENCE / name)
    outside = leave_one_out(stored, members)
    if not any(outside.values()):
        write_ensemble(REFERENCE / name, list(members.values()))
    row = {"tables": name, **summary(Ensemble.of(stored, list(members.values())), stored, outside)}
    earlier = read_table(TABLE)
    rows = {row["tables"]: row for row in (*earlier.to_dict("records"), row)}
    table = pd.DataFrame([rows[key] for key in CONFIGURATIONS if key in rows])
    store_table(TABLE, table, MODULE)
    sys.stdout.write(f"{table.to_string(index=False)}\n")


def run(name: str, member: str) -> None:
    """Make the tables of a member, unless they are there, and keep nothing else; InputError if the run fails."""
    kept, results = RESULTS / name / member, RESULTS / name / f"{member}.part"
    if kept.is_dir():
        return
    files = [file.name for file in sorted((REFERENCE / name).glob("*.csv")) if file.name != ENSEMBLE]
    stated = (f"results={results}", f"jitter={0 if member in PROCESSORS else member}")
    command = (*RUN, "--configfile", *CONFIGURATIONS[name], "--config", *stated, "--")
    log = RESULTS / name / f"{member}.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("w") as stream:
        code = subprocess.run(
            [*command, *(f"{results}/tables/{file}" for file in files)],
            env=os.environ | PROCESSORS.get(member, {}),
            stdout=stream,
            stderr=stream,
        ).returncode
    if code:
        raise InputError(f"{log}: the run of member {member} ended with {code}; mend its cause and run again")
    (results / "tables").rename(kept)
    shutil.rmtree(results)
    sys.stdout.write(f"{name}: member {member} has ended\n")
    sys.stdout.flush()


def summary(ensemble: Ensemble, stored: Tables, outside: Mapping[str, Sequence[Move]]) -> dict[str, str]:
    """Return how many cells hold how many digits, how many have words that vary, and which members disagree."""
    held = Counter(
        inf if digits == inf else int(digits)
        for name, table in stored.items()
        if name not in UNHELD
        for column in table
        for row, text in enumerate(table[column])
        for digits in (ensemble.digits((name, row, str(column)), text),)
    )
    disagreeing = sorted({move.cell[0] for moves in outside.values() for move in moves})
    return {
        "runs": str(ensemble.members),
        "cells with numbers": str(sum(held.values()) - held[inf]),
        **{f"{digits} digits": str(held[digits]) for digits in range(MOST_DIGITS)},
        "all that are printed": str(held[MOST_DIGITS]),
        "words vary": str(sum(len(by_words) > 1 for by_words in ensemble.spreads.values())),
        "runs that agree, left out": str(sum(not moves for moves in outside.values())),
        "cells of the others outside": str(sum(map(len, outside.values()))),
        "in the tables": " ".join(disagreeing),
    }


if __name__ == "__main__":
    os.chdir(ROOT)
    main(sys.argv[1], int(sys.argv[2]), "--store" in sys.argv)
