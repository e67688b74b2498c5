"""The forecast of a study in a few lines of Markdown."""

from collections.abc import Sequence

from heartfit.planning.forecast import Part, Subjects, each, whole
from heartfit.planning.own_time import HERE, SHARE, largest_shard

HEADER = "| of each | jobs | CPU h | files | GB |\n|---|---|---|---|---|\n"
NODES = (1, 4, 8, 16)
"""CPUs that one Snakemake may keep busy."""


def forecast_page(parts: Sequence[Part], subjects: Subjects, cpus: int) -> str:
    """What is there for each study, case, setting and point, the sum, and how to split the graph."""
    total = whole(parts)
    days = total.seconds / cpus / 86400.0
    each_has = f"{subjects.settings} settings, {subjects.points} sigma points each"
    title = f"{subjects.number} {subjects.kind} subjects, {each_has}"
    table = HEADER + "".join(map(_row, (*parts, total)))
    return f"{title}\n\n{table}\n{days:.3g} days on {cpus} CPUs.\n\n{_own_time(total, each(parts, subjects))}"


def _row(part: Part) -> str:
    hours, held = part.seconds / 3600.0, part.megabytes / 1000.0
    return f"| {part.per} | {part.jobs:.0f} | {hours:.3g} | {part.files:.0f} | {held:.3g} |\n"


def _own_time(total: Part, subject: Part) -> str:
    """How long one graph of all would take Snakemake, and the subjects that a graph may hold."""
    alone = HERE.of(total.jobs) / 3600.0
    lines = [
        f"Snakemake itself: {alone:.3g} h for one graph of all; below {100 * SHARE:.0f} % of the time on the wall with"
    ]
    for cpus in NODES:
        size = largest_shard(subject.jobs, subject.seconds, cpus)
        lines.append(
            f"- {cpus} CPUs a graph: " + (f"up to {size} subjects" if size else "no graph, take fewer CPUs")
        )
    return "\n".join(lines) + "\n"
