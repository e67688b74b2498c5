"""Study through a real SLURM with a lost job and a lost node, compared with an undisturbed run."""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from threading import Thread

from tests.slurm.lab import Lab, LabError, await_that, install

RESULTS = Path("results/tiny")
TINY = ("--configfile", "config/tiny.yaml", "--", f"{RESULTS}/tables/numbers.csv")
UNEQUAL = ("logs", "benchmarks", ".sums")
"""Files that depend on times and on the order of jobs."""
AGAIN, PROGRESS = "Trying to restart job", re.compile(r"steps \((\d+)%\) done")
KILLED_AT, LOST_AT = 10, 50
"""% of the study that are done when a job is killed and when the node is lost."""
GOING = ("RUNNING", "COMPLETING")
"""States of a job that has not ended."""
LONG = 3600.0
"""s within which a study must have got to the next job."""


class Study:
    """Snakemake with the project's profile, and what it has printed so far."""

    def __init__(self, arguments: list[str]) -> None:
        profile = ["--workflow-profile", "profiles/slurm"]
        # polls more often than is polite on a shared cluster
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
            if PROGRESS.search(line) or line.startswith("Error") or AGAIN in line:
                say(line.rstrip())

    def ended(self) -> bool:
        """True if no job is left."""
        return self.process.poll() is not None

    def code(self) -> int:
        """Wait for its end; 0 if all that was asked for is there."""
        self.reader.join()
        return self.process.wait()

    def share(self) -> int:
        """Share of finished jobs [%]."""
        shares = [int(match[1]) for line in self.lines if (match := PROGRESS.search(line))]
        return shares[-1] if shares else 0

    def restarts(self) -> int:
        """Number of jobs that Snakemake repeated."""
        return sum(AGAIN in line for line in self.lines)


def main(arguments: list[str]) -> int:
    """Print the losses and their outcome; 0 if all lost jobs ran again and the study is complete with right tables."""
    parser = argparse.ArgumentParser(prog="python -m tests.slurm", description=__doc__)
    parser.add_argument("--cpus", type=int, default=len(os.sched_getaffinity(0)), help="of the node")
    options, rest = parser.parse_known_args(arguments)
    if not rest:
        shutil.rmtree(RESULTS, ignore_errors=True)
    try:
        install()
        with lab(options.cpus) as slurm:
            trial(slurm, rest or list(TINY))
        return len(differing(options.cpus)) if not rest else 0
    except LabError as problem:
        say(str(problem))
        return 1


def differing(cpus: int) -> list[str]:
    """Names of the results of the small study that differ from those of a run on this machine alone; also printed."""
    through = RESULTS.with_name(f"{RESULTS.name}_through_slurm")
    shutil.rmtree(through, ignore_errors=True)
    RESULTS.rename(through)
    say("the same without SLURM")
    command = [sys.executable, "-m", "snakemake", "--cores", str(cpus), *TINY]
    subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
    there, here = results_in(through), results_in(RESULTS)
    others = sorted(name for name in here.keys() | there.keys() if here.get(name) != there.get(name))
    say(f"{len(here)} results compared, {', '.join(others) or 'none'} differ")
    return others


def results_in(folder: Path) -> dict[str, bytes]:
    """Every result by name, except for those that depend on times."""
    files = [file for file in folder.rglob("*") if file.is_file()]
    named = {file.relative_to(folder): file for file in files}
    return {str(name): file.read_bytes() for name, file in named.items() if name.parts[0] not in UNEQUAL}


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


def trial(slurm: Lab, arguments: list[str]) -> None:
    """Run the study, kill a job, cut the node's power, and see it through; raises LabError if it does not recover."""
    begin, study = time.monotonic(), Study(arguments)
    killed = kill_one(slurm, study)
    lost = lose_some(slurm, study)
    code, states = study.code(), slurm.states()
    whole = sum(state == "COMPLETED" for state in states.values())
    minutes = (time.monotonic() - begin) / 60.0
    say(f"{whole} of {len(states)} jobs completed, {study.restarts()} tried again, {minutes:.1f} min")
    require(states[killed] == "FAILED", f"job {killed} was killed and ended as {states[killed]}")
    require(states[lost] == "NODE_FAIL", f"job {lost} was lost and ended as {states[lost]}")
    require(study.restarts() >= 2, f"{study.restarts()} jobs were tried again; expected both that were lost")
    require(code == 0, f"the study is not complete: Snakemake ended with {code}")


def kill_one(slurm: Lab, study: Study) -> int:
    """Kill a running job and return its number; another one if it has completed before the signal reached it."""
    while True:
        killed = running(slurm, study, KILLED_AT)[0]
        slurm.kill_job(killed)
        await_that(lambda job=killed: slurm.states()[job] not in GOING, f"the end of job {killed}")
        say(f"killed all processes of job {killed}; SLURM says {slurm.states()[killed]}")
        if slurm.states()[killed] != "COMPLETED":
            return killed


def lose_some(slurm: Lab, study: Study) -> int:
    """Cut the node's power and start it again; return a lost job, after another cut if all had completed before."""
    while True:
        ran = running(slurm, study, LOST_AT)
        slurm.lose_node()
        ended = {job: slurm.states()[job] for job in ran}
        say(f"node lost; SLURM says {', '.join(f'job {job} {state}' for job, state in ended.items())}")
        slurm.start_node()
        lost = [job for job, state in ended.items() if state != "COMPLETED"]
        if lost:
            return lost[0]


def require(holds: bool, otherwise: str) -> None:
    """Raise LabError if something does not hold."""
    if not holds:
        raise LabError(otherwise)


def say(line: str) -> None:
    """Print a line at once."""
    sys.stdout.write(f"slurm: {line}\n")
    sys.stdout.flush()


def running(slurm: Lab, study: Study, share: int) -> list[int]:
    """Numbers of the jobs whose step has begun once so much is done; raises LabError if the study ends before that."""
    begun: list[int] = []

    def some() -> bool:
        begun[:] = [job for job in slurm.jobs() if len(slurm.processes(job)) > 1]
        return study.ended() or (study.share() >= share and bool(begun))

    await_that(some, "a job that runs", LONG)
    require(not study.ended(), "the study ended before all of it was tried: is there anything left to do?")
    return begun
