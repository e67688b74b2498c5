"""The page of fifty subjects, in Markdown."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from heartfit.planning.forecast import Part, whole

HEADER = """# Fifty subjects, planned and run

Written by `python -m benchmarks.campaign`. A study of a few coarse virtual hearts (`config/tiny.yaml`, anatomies drawn
from normal values) is run, `heartfit costs` measures what its jobs took, `heartfit shards` splits many into {shards}
studies of their own, the reference case in each, each is run on {cpus} CPUs, and `heartfit join` puts their numbers
together: {joined} cases in one table. The forecast, which is that of `heartfit plan`, was made before the run.

| of all shards | planned | run | run / planned |
|---|---|---|---|
"""
OWN = """
## Snakemake's own time

| graph | jobs | min | Snakemake's CPU s | of the time on the wall | of the CPUs' time |
|---|---|---|---|---|---|
"""
FOOTER = """
Jobs of such coarse hearts take {mean:.1f} s, those of the study's meshes 10 s: there the same graph would take
{share:.1f} % of the CPUs' time. [On a cluster](cluster.md) has the plan for thousands.
"""
STUDY_S = 10.0
"""Seconds of a mean job of the whole study, docs/cluster.md."""


@dataclass(frozen=True)
class Ran:
    """A study that was run: its folder, what it came to, its time on the wall and Snakemake's own CPU time, s."""

    results: Path
    part: Part
    wall: float
    own: float


def campaign_page(few: Ran, planned: Sequence[Part], runs: Sequence[Ran], joined: int, cpus: int) -> str:
    """What was planned beside what was run, and what Snakemake took for itself."""
    wanted, found = whole(planned), whole([run.part for run in runs])
    rows = [
        ("jobs", wanted.jobs, found.jobs),
        ("CPU h of jobs", wanted.seconds / 3600.0, found.seconds / 3600.0),
        ("files", wanted.files, found.files),
        ("MB", wanted.megabytes, found.megabytes),
    ]
    table = "".join(f"| {name} | {a:.4g} | {b:.4g} | {b / a:.3f} |\n" for name, a, b in rows)
    own = "".join(_own(run, cpus) for run in (few, *runs))
    header = HEADER.format(shards=len(runs), cpus=cpus, joined=joined)
    mean = found.seconds / found.jobs
    share = 100.0 * sum(run.own for run in runs) / found.jobs / STUDY_S
    return header + table + OWN + own + FOOTER.format(mean=mean, share=share)


def _own(run: Ran, cpus: int) -> str:
    of_wall, of_cpus = 100.0 * run.own / run.wall, 100.0 * run.own / (cpus * run.wall)
    took = f"{run.wall / 60.0:.1f} | {run.own:.1f} | {of_wall:.1f} % | {of_cpus:.1f} % |"
    return f"| `{run.results.name}` | {run.part.jobs:.0f} | {took}\n"
