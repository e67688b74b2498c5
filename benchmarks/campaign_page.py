"""Page of fifty subjects, in Markdown."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from heartfit.core.pages import render_page
from heartfit.study.forecast import Part, total_of

STUDY_S = 10.0
"""Mean duration of a job of the whole study [s], docs/cluster.md."""


@dataclass(frozen=True)
class Ran:
    """A completed study: its folder, its totals, its wall time and the CPU time of Snakemake [s]."""

    results: Path
    part: Part
    wall: float
    own: float


def campaign_page(few: Ran, planned: Sequence[Part], runs: Sequence[Ran], merged: int, cpus: int) -> str:
    """Compare forecast and measured figures, with the CPU time of Snakemake."""
    wanted, measured = total_of(planned), total_of([run.part for run in runs])
    rows = [
        ("jobs", wanted.jobs, measured.jobs),
        ("CPU h of jobs", wanted.seconds / 3600.0, measured.seconds / 3600.0),
        ("files", wanted.files, measured.files),
        ("MB", wanted.megabytes, measured.megabytes),
    ]
    table = "".join(f"| {name} | {a:.4g} | {b:.4g} | {b / a:.3f} |\n" for name, a, b in rows)
    own = "".join(_own(run, cpus) for run in (few, *runs))
    return render_page(
        "campaign",
        shards=len(runs),
        cpus=cpus,
        joined=merged,
        table=table,
        own=own,
        mean=measured.seconds / measured.jobs,
        share=100.0 * sum(run.own for run in runs) / measured.jobs / STUDY_S,
    )


def _own(run: Ran, cpus: int) -> str:
    of_wall, of_cpus = 100.0 * run.own / run.wall, 100.0 * run.own / (cpus * run.wall)
    took = f"{run.wall / 60.0:.1f} | {run.own:.1f} | {of_wall:.1f} % | {of_cpus:.1f} % |"
    return f"| `{run.results.name}` | {run.part.jobs:.0f} | {took}\n"
