"""Fifty subjects as tables: the forecast beside the run, and the time of Snakemake."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from heartfit.study.forecast import Part, total_of


@dataclass(frozen=True)
class Ran:
    """A completed study: its folder, its totals, its wall time and the CPU time of Snakemake [s]."""

    results: Path
    part: Part
    wall: float
    own: float


def forecast_table(planned: Sequence[Part], runs: Sequence[Ran]) -> pd.DataFrame:
    """Compare forecast and measured totals of all shards."""
    wanted, measured = total_of(planned), total_of([run.part for run in runs])
    rows = [
        ("jobs", wanted.jobs, measured.jobs),
        ("CPU h of jobs", wanted.seconds / 3600.0, measured.seconds / 3600.0),
        ("files", wanted.files, measured.files),
        ("MB", wanted.megabytes, measured.megabytes),
    ]
    cells = [(name, f"{a:.4g}", f"{b:.4g}", f"{b / a:.3f}") for name, a, b in rows]
    return pd.DataFrame(cells, columns=["of all shards", "planned", "run", "run / planned"])


def snakemake_table(runs: Sequence[Ran], cpus: int) -> pd.DataFrame:
    """Return the CPU time of Snakemake itself for each graph, over the time on the wall and that of the CPUs."""
    return pd.DataFrame([_own(run, cpus) for run in runs])


def _own(run: Ran, cpus: int) -> dict[str, str]:
    return {
        "graph": f"`{run.results.name}`",
        "jobs": f"{run.part.jobs:.0f}",
        "min": f"{run.wall / 60.0:.1f}",
        "Snakemake's CPU s": f"{run.own:.1f}",
        "of the time on the wall": f"{100.0 * run.own / run.wall:.1f} %",
        "of the CPUs' time": f"{100.0 * run.own / (cpus * run.wall):.1f} %",
    }
