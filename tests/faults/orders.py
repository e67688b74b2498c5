"""Other numbers of threads and other orders of the jobs."""

from io import StringIO
from random import Random

import pandas as pd

from tests.faults.outcome import Outcome, one_more_call
from tests.faults.tiny import RESULTS, TinyStudy, finish

THREADS = 'environ[f"{library}_NUM_THREADS"] = "%d"'


def orders(
    study: TinyStudy, expected: dict[str, str], chance: Random, threads: tuple[int, ...]
) -> list[Outcome]:
    """Complete runs from an empty folder with given numbers of threads per job, each with another order of the jobs."""
    ways = (
        ("--cores", "1"),
        ("--cores", "3", "--scheduler", "greedy"),
        ("--cores", "2", "--scheduler", "greedy"),
    )
    outcomes = []
    for count, way in zip(threads, ways, strict=False):
        study.wipe()
        first = chance.sample(sorted(expected), 8)
        with study.edited("workflow/common/study.smk", THREADS % 1, THREADS % count):
            same = one_more_call(
                study, expected, *way, "--prioritize", *(f"{RESULTS}/{name}" for name in first)
            )
        threads_of_job = f"{count} thread{'s' * (count > 1)} in each job"
        fault = f"from an empty folder with {threads_of_job}, `{' '.join(way)}`, eight random results first"
        outcomes.append(Outcome(fault, "identical tables" if same else "different tables", same))
    return outcomes


CLOSE = 1e-3
"""Largest difference of a number of the tables on another processor, as a share of it."""
OLD_PROCESSOR = {
    "OPENBLAS_CORETYPE": "Nehalem",
    "NUMBA_CPU_NAME": "x86-64",
    "NPY_DISABLE_CPU_FEATURES": "X86_V3 X86_V4 AVX512_ICL AVX512_SPR",
    "NUMBA_CACHE_DIR": "kernels-of-an-old-processor",
}
"""Environment in which libraries and compiled kernels act as on a processor of 2008, without AVX and FMA."""


def other_processor(study: TinyStudy, expected: dict[str, str]) -> list[Outcome]:
    """Complete run from an empty folder as on another machine, where the last digits differ."""
    study.put_back()
    numbers = study.folder / RESULTS / "tables" / "numbers.csv"
    before = _numbers(numbers.read_text())
    study.wipe()
    code, _ = finish(study.start(environment=OLD_PROCESSOR))
    after = _numbers(numbers.read_text())
    largest = ((after - before).abs() / before.abs().clip(lower=1e-12)).max()
    fault = "from an empty folder, with the arithmetic of a processor of 2008 (no AVX, no FMA)"
    same = f"{_same(study, expected)} of {len(expected)} results identical"
    came = f"{same}; the numbers of the tables differ by at most {largest:.0e}"
    return [Outcome(fault, came, code == 0 and len(after) == len(before) and largest < CLOSE)]


def _same(study: TinyStudy, expected: dict[str, str]) -> int:
    sums = study.sums()
    return sum(sums.get(name) == digest for name, digest in expected.items())


def _numbers(text: str) -> "pd.Series[float]":
    table = pd.read_csv(StringIO(text), comment="#")
    return pd.to_numeric(table["value"], errors="coerce").dropna()
