"""Processes that end in the middle of their work."""

import time
from contextlib import suppress
from functools import partial
from random import Random

import psutil

from tests.faults.outcome import Outcome, half_written, one_more_call
from tests.faults.tiny import TinyStudy, finish, kill

STARTING = 4.0  # s until the first job
SPREAD = 6.0  # s over which the moments of a kill are spread


def kills(
    study: TinyStudy, expected: dict[str, str], chance: Random, times: int, short: bool
) -> list[Outcome]:
    """SIGKILL to Snakemake and all jobs, repeatedly, from an empty folder to the last table.

    short: from the registration errors on, half of the jobs.
    """
    begin = partial(_from_halfway, study) if short else study.wipe
    begin()
    seconds, spoilt, drafts = [], [], 0
    while len(seconds) < times:
        after = chance.uniform(0.0, STARTING + SPREAD)
        if not kill(study.start(), after):
            begin()  # it had ended before
            continue
        seconds.append(after)
        spoilt += half_written(study, expected)
        drafts += len(study.left_over())
    mended = one_more_call(study, expected) and not spoilt and not study.left_over()
    moments = ", ".join(f"{after:.1f}" for after in seconds)
    way = "half of the jobs" if short else "an empty folder"
    fault = (
        f"SIGKILL to all processes, {times} times from {way} to the tables, after {moments} s of each call"
    )
    came = f"{drafts} drafts left and removed, {len(spoilt)} incomplete files under their final name"
    return [Outcome(fault, came, mended)]


def _from_halfway(study: TinyStudy) -> None:
    study.put_back()
    study.remove("volunteer1", "sensitivity", "tables", "figures")


def orphans(study: TinyStudy, expected: dict[str, str], chance: Random) -> list[Outcome]:
    """SIGKILL to Snakemake alone: its jobs live on while the next call begins."""
    study.put_back()
    study.remove("volunteer1/physical", "tables", "figures")
    process = study.start()
    time.sleep(STARTING + chance.uniform(2.0, SPREAD))
    process.kill()
    mended = one_more_call(study, expected)
    finish(process)
    fault = "SIGKILL to Snakemake alone, and the next call while its jobs continue"
    return [Outcome(fault, "both write the same files", mended)]


def job_killed(study: TinyStudy, expected: dict[str, str], chance: Random) -> list[Outcome]:
    """SIGKILL to one job, as when memory is short."""
    study.put_back()
    study.remove("volunteer1/physical", "tables", "figures")
    process = study.start()
    victim = _job_of(process.pid, STARTING + chance.uniform(2.0, SPREAD))
    victim.kill()
    code, _ = finish(process)
    mended = one_more_call(study, expected) and code != 0
    return [Outcome("SIGKILL to one job, as if memory ran out", f"the call ended with {code}", mended)]


def _job_of(leader: int, after: float) -> psutil.Process:
    """A job that Snakemake is running, once some seconds are over."""
    time.sleep(after)
    for _ in range(600):
        for child in psutil.Process(leader).children(recursive=True):
            with suppress(psutil.NoSuchProcess):  # it has ended meanwhile
                if ".snakemake/scripts" in " ".join(child.cmdline()) and "python" in child.name():
                    return child
        time.sleep(0.05)
    raise TimeoutError("no job was at work for half a minute")
