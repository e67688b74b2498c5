"""All faults on the smallest study, and their table."""

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

import pandas as pd

from heartfit.io.tables import write_measured
from tests.checkout import ROOT
from tests.faults.clocks import clocks, jumping_clock
from tests.faults.damage import cut_kernels, damaged
from tests.faults.disks import full_disk, read_only
from tests.faults.kills import job_killed, kills, orphans
from tests.faults.orders import orders, other_processor
from tests.faults.outcome import Outcome
from tests.faults.tiny import TinyStudy
from tests.faults.together import two_folders, two_runs

STORED = ROOT / "docs" / "measured" / "faults.tsv"
SEED = 2012


def main(arguments: list[str]) -> int:
    """Try all faults and store the table, or a part of them; 1 if one was not mended."""
    parser = argparse.ArgumentParser(prog="python3 study.py faults", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer kills, some of the rest, and no table")
    quick = parser.parse_args(arguments).quick
    with TemporaryDirectory() as folder:
        study = TinyStudy(Path(folder))
        if quick:
            study.adopt()
        expected = _reference(study)
        outcomes = list(_all(study, expected, quick))
    if not quick:
        write_measured(STORED, table(outcomes), "python3 study.py faults")
    return int(not all(outcome.mended for outcome in outcomes))


def _reference(study: TinyStudy) -> dict[str, str]:
    """Results of an undisturbed study, kept as the starting point."""
    begin = time.monotonic()
    code, output = study.run()
    if code:
        raise RuntimeError(f"the study fails without a fault:\n{output}")
    study.keep()
    _say(f"a study without faults took {time.monotonic() - begin:.0f} s")
    return study.sums()


def _all(study: TinyStudy, expected: dict[str, str], quick: bool) -> Iterator[Outcome]:
    for fault in _faults(Random(SEED), quick):
        begin = time.monotonic()
        for outcome in fault(study, expected):
            _say(f"{'mended' if outcome.mended else 'NOT MENDED'}: {outcome.fault}: {outcome.came}")
            yield outcome
        _say(f"  in {time.monotonic() - begin:.0f} s")


def _faults(chance: Random, quick: bool) -> list[Callable[[TinyStudy, dict[str, str]], list[Outcome]]]:
    drawn = [
        partial(kills, times=2 if quick else 20, short=quick),
        orphans,
        job_killed,
        partial(damaged, ways=1 if quick else 4),
        cut_kernels,
        partial(clocks, ways=1 if quick else 3),
        jumping_clock,
        *([] if quick else [partial(orders, threads=(1, 2, 4))]),
    ]
    plain = [full_disk, read_only, two_runs, *([] if quick else [two_folders, other_processor])]
    return [*plain, *(partial(fault, chance=chance) for fault in drawn)]


def table(outcomes: list[Outcome]) -> pd.DataFrame:
    """One row for each fault."""
    rows = [(outcome.fault, outcome.came, "yes" if outcome.mended else "**no**") for outcome in outcomes]
    return pd.DataFrame(rows, columns=["fault", "consequence", "repaired by one more call"])


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()
