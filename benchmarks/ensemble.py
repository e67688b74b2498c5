"""Numerical error of every number of a study, from an ensemble: python -m benchmarks.ensemble NAME MEMBERS [--store]

NAME: a folder of resources/reference. Each member is a run whose jobs read positions moved by 1e-12 of themselves and
voxels by one unit in the last place; two more are unmoved, with the arithmetic of older processors. Two members run at
a time, those that have ended are kept in results/ensemble, and their means, deviations and words are stored beside the
tables.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from benchmarks.ventricles import ROOT
from heartfit.core.errors import InputError
from heartfit.io.reference import read_held_tables, write_ensemble

CONFIGURATIONS = {
    "smoke": ("config/smoke.yaml",),
    "study": ("config/config.yaml",),
    "measured_heart_smoke": ("config/measured_heart.yaml", "config/measured_heart_smoke.yaml"),
    "measured_heart": ("config/measured_heart.yaml",),
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
RUN = (sys.executable, "-m", "snakemake", "--cores", "1", "--scheduler", "greedy", "--quiet", "all")


def main(name: str, members: int, store: bool) -> None:
    """Run the members that are missing, two at a time, and store the ensemble; `store` stores those that there are."""
    names = [*PROCESSORS, *map(str, range(1, members + 1))]
    if not store:
        with ThreadPoolExecutor(2) as pool:
            list(pool.map(lambda member: run(name, member), names))
    there = [folder_of(name, member) for member in names if folder_of(name, member).is_dir()]
    write_ensemble(REFERENCE / name, list(map(read_held_tables, there)))
    sys.stdout.write(f"{name}: ensemble of {len(there)} members\n")


def folder_of(name: str, member: str) -> Path:
    """Return the folder of the tables of a member that has ended."""
    return RESULTS / name / member


def run(name: str, member: str) -> None:
    """Make the tables of a member, unless they are there, and keep nothing else; InputError if the run fails."""
    kept, results = folder_of(name, member), RESULTS / name / f"{member}.part"
    if kept.is_dir():
        return
    tables = [f"{results}/tables/{file.name}" for file in sorted((REFERENCE / name).glob("*.csv"))]
    stated = (f"results={results}", f"jitter={0 if member in PROCESSORS else member}")
    command: Sequence[str] = [
        *(*RUN, "--configfile", *CONFIGURATIONS[name], "--config", *stated),
        *("--", *(table for table in tables if not table.endswith("/ensemble.csv"))),
    ]
    log = RESULTS / name / f"{member}.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("w") as stream:
        code = subprocess.run(
            command, cwd=ROOT, env=os.environ | PROCESSORS.get(member, {}), stdout=stream, stderr=stream
        ).returncode
    if code:
        raise InputError(f"{log}: the run of member {member} ended with {code}; mend its cause and run again")
    (results / "tables").rename(kept)
    shutil.rmtree(results)
    sys.stdout.write(f"{name}: member {member} has ended\n")
    sys.stdout.flush()


if __name__ == "__main__":
    os.chdir(ROOT)
    main(sys.argv[1], int(sys.argv[2]), "--store" in sys.argv)
