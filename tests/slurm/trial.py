"""The study through a real SLURM, a job and a node being lost on the way."""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Thread

from tests.slurm.lab import Lab, LabError, await_that, install

SMOKE = ("all", "check_numbers", "--configfile", "config/smoke.yaml")
AGAIN = "Trying to restart job"
LONG = 3600.0
"""s within which a study must have got to the next job."""


class Study:
    """Snakemake with the project's profile, and what it has printed so far."""

    def __init__(self, arguments: list[str], cpus: int) -> None:
        profile = ["--workflow-profile", "profiles/slurm", "--cores", str(cpus)]
        # the lab looks more often than one should on a cluster that others use
        often = ["--slurm-init-seconds-before-status-checks", "3", "--seconds-between-status-checks", "3"]
        command = [sys.executable, "-m", "snakemake", *profile, *often, *arguments]
        say(" ".join(command[1:]))
        self.lines: list[str] = []
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.reader = Thread(target=self._read)
        self.reader.start()

    def _read(self) -> None:
        for line in self.process.stdout or ():
            self.lines.append(line)
            if " steps (" in line or "rror" in line or AGAIN in line:
                say(line.rstrip())

    def ended(self) -> bool:
        """Whether it has nothing left to do."""
        return self.process.poll() is not None

    def code(self) -> int:
        """Wait for its end; 0 if all that was asked for is there."""
        self.reader.join()
        return self.process.wait()

    def restarts(self) -> int:
        """How many jobs Snakemake tried again."""
        return sum(AGAIN in line for line in self.lines)


def main(arguments: list[str]) -> int:
    """Run it and say what was lost and what came of it; 0 if the study is complete and all that was lost ran again."""
    parser = argparse.ArgumentParser(prog="python -m tests.slurm", description=__doc__)
    parser.add_argument("--cpus", type=int, default=len(os.sched_getaffinity(0)), help="of the node")
    given, rest = parser.parse_known_args(arguments)
    try:
        install()
        with lab(given.cpus) as slurm:
            return trial(slurm, given.cpus, rest or list(SMOKE))
    except LabError as problem:
        say(str(problem))
        return 1


@contextmanager
def lab(cpus: int) -> Iterator[Lab]:
    """A SLURM that is up; its daemons end with the block."""
    with tempfile.TemporaryDirectory(prefix="heartfit-slurm-") as folder:
        slurm = Lab(Path(folder), cpus)
        try:
            slurm.up()
            yield slurm
        finally:
            slurm.down()


def trial(slurm: Lab, cpus: int, arguments: list[str]) -> int:
    """Run the study, kill a job, cut the node's power, and see it through."""
    begin, study = time.monotonic(), Study(arguments, cpus)
    killed = running(slurm, study)
    slurm.kill_job(killed)
    say(f"killed all processes of job {killed}")
    await_that(lambda: slurm.states()[killed] != "RUNNING", f"the end of job {killed}")
    lost = running(slurm, study)
    slurm.lose_node()
    say(f"node lost with job {lost}; SLURM says {slurm.states()[lost]}")
    slurm.start_node()
    code, states = study.code(), slurm.states()
    again, missed = study.restarts(), {killed: "FAILED", lost: "NODE_FAIL"}
    for job, expected in missed.items():
        say(f"job {job} ended as {states[job]}, expected {expected}")
    whole = sum(state == "COMPLETED" for state in states.values())
    minutes = (time.monotonic() - begin) / 60.0
    say(f"{whole} of {len(states)} jobs completed, {again} of Snakemake's tried again, {minutes:.1f} min")
    return int(code != 0 or any(states[job] != end for job, end in missed.items()) or again < len(missed))


def say(line: str) -> None:
    """Print a line at once."""
    sys.stdout.write(f"slurm: {line}\n")
    sys.stdout.flush()


def running(slurm: Lab, study: Study) -> int:
    """The number of a job whose step has begun; raises LabError if the study ends before there is one."""

    def found() -> int:
        return next((job for job in slurm.jobs() if len(slurm.processes(job)) > 1), 0)

    await_that(lambda: study.ended() or found() > 0, "a job that runs", LONG)
    if study.ended():
        raise LabError("the study ended before all of it was tried: is there anything left to do?")
    return found()
