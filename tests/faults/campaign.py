"""Every fault in turn on the smallest study, and the page that tells of them."""

import argparse
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

from tests.faults.clocks import clocks, jumping_clock
from tests.faults.damage import cut_kernels, damaged
from tests.faults.disks import full_disk, read_only
from tests.faults.kills import job_killed, kills, orphans
from tests.faults.orders import orders, other_processor
from tests.faults.outcome import Outcome
from tests.faults.tiny import ROOT, TinyStudy
from tests.faults.together import two_folders, two_runs

PAGE = ROOT / "docs" / "faults.md"
SEED = 2012
HEADER = """# Faults

What was done to the smallest study there is (`config/tiny.yaml`, one virtual volunteer, {files} results), and what came
of it. After each fault one more call, the same as before, has to complete, with every result identical to the bit to
those of a study that nothing happened to: {kinds}. Only logs and benchmarks, which tell
of times, are left out. This page is written by `python3 study.py faults`; `--quick` tries a part of it, in ten
minutes on two cores.

| what was done | what came of it | mended by one more call |
|---|---|---|
"""
FOOTER = """
## What it rests on

- **Whole or not at all.** Every file is written as a draft in a folder `.draft-*` beside its place, brought to the
  disk, and then renamed. Snakemake notes which jobs were under way and does them again.
- **Sums.** `results/.sums/` holds the SHA-256 of every file as it was written, as `sha256sum` prints it. A file that is
  not what was written is set aside as `*.altered` at the beginning of the next call, which says so, and is made again
  where it is needed. An edit by hand is found, too. Files of an older version have no sum and are taken as they are.
- **Locks.** Snakemake's lock of a killed run stays and would refuse the next one. Each run also holds a lock of the
  system's on `.snakemake/heartfit.lock`, which goes with its process. A run that gets it alone takes stale locks and
  drafts away. On a file system that knows no such locks, `snakemake --unlock` is yours to call.
- **Clocks.** Snakemake goes by dates. Results from the future are dated now, before anything runs.
- **The same again.** The same inputs give the same bytes, meshes included
  ([decision 21](decisions/021-same-mesh-twice.md)), see [reproducible](reproducible.md).

A dry run (`-n`) puts things in order, too: Snakemake does not tell the two apart before it reads the workflow.

Not covered: a byte that changes in numba's compiled kernels (their files have no sum; delete
`src/heartfit/__pycache__`), a result that changes while a run that needs it is at work, and inputs of yours that are
dated in the future (Snakemake says so; `touch` them).
"""


def main(arguments: list[str]) -> int:
    """Try all faults and write the page, or a part of them; 1 if one was not mended."""
    parser = argparse.ArgumentParser(prog="python3 study.py faults", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="fewer kills, some of the rest, and no page")
    quick = parser.parse_args(arguments).quick
    with TemporaryDirectory() as folder:
        study = TinyStudy(Path(folder))
        expected = _reference(study)
        outcomes = list(_all(study, expected, quick))
    if not quick:
        PAGE.write_text(page(expected, outcomes))
    return int(not all(outcome.mended for outcome in outcomes))


def _reference(study: TinyStudy) -> dict[str, str]:
    """The results of a study that nothing happens to, kept to begin from."""
    begin = time.monotonic()
    code, said = study.run()
    if code:
        raise RuntimeError(f"the study fails without a fault:\n{said}")
    study.keep()
    _say(f"a study without faults took {time.monotonic() - begin:.0f} s")
    return study.sums()


def _all(study: TinyStudy, expected: dict[str, str], quick: bool) -> Iterator[Outcome]:
    for fault in _faults(Random(SEED), quick):
        begin = time.monotonic()
        for outcome in fault(study, expected):
            _say(f"{'mended' if outcome.mended else 'NOT MENDED'}: {outcome.done}: {outcome.came}")
            yield outcome
        _say(f"  in {time.monotonic() - begin:.0f} s")


def _faults(chance: Random, quick: bool) -> list[Callable[[TinyStudy, dict[str, str]], list[Outcome]]]:
    drawn = [
        partial(kills, times=4 if quick else 20, short=quick),
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


def page(expected: dict[str, str], outcomes: list[Outcome]) -> str:
    """The table of what was done."""
    kinds = ", ".join(sorted({f"`{Path(name).suffix}`" for name in expected}))
    rows = "".join(
        f"| {outcome.done} | {outcome.came} | {'yes' if outcome.mended else '**no**'} |\n"
        for outcome in outcomes
    )
    return HEADER.format(files=len(expected), kinds=kinds) + rows + FOOTER


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()
