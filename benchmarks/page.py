"""Page of performance, in Markdown: all figures with targets, then the tables of the measurements."""

import platform
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks import sphere
from benchmarks.figure import Figure
from benchmarks.growth import growth
from benchmarks.job import Job
from benchmarks.newton import Newton
from heartfit.core.pages import render_page, table_row

ELEMENTS = {"physical": "mixed", "locking": "p1"}
Cost = dict[str, float]


@dataclass(frozen=True)
class Measured:
    """All measurements of a run: beats by (mesh, setting), Newton steps, a job, spheres, the engine now and before."""

    beats: dict[tuple[str, str], Cost]
    newton: Sequence[Sequence[Newton]]
    job: Job
    spheres: dict[str, tuple[float, float]]
    time_step: float
    engine: dict[str, float]
    before: dict[str, float]
    commit: str = ""


def page(measured: Measured, figures: Sequence[Figure]) -> str:
    """Render the page."""
    growths = " and ".join(f"{exponent(measured, s):.2f} (`{ELEMENTS[s]}`)" for s in ELEMENTS)
    smallest = next(iter(measured.beats.values()))
    newton = (
        _newton_row(step, group[0], iteration(measured, step)) for group in measured.newton for step in group
    )
    return render_page(
        "performance",
        machine=machine(),
        commit=measured.commit,
        figures="".join(figure.row() for figure in figures),
        tried=list(dict.fromkeys(figure.tried for figure in figures if figure.tried and not figure.met)),
        step=1e3 * measured.time_step,
        growths=growths,
        beats="".join(_beat_row(setting, cost) for (_, setting), cost in measured.beats.items()),
        newton="".join(newton),
        tetrahedra=smallest["tetrahedra"],
        overhead=measured.job.overhead,
        **vars(measured.job),
        spheres="".join(table_row(*row) for row in sphere.rows(measured.spheres)),
    )


def exponent(measured: Measured, setting: str) -> float:
    """Growth exponents of the CPU time with the number of tetrahedra."""
    costs = [cost for (_, of), cost in measured.beats.items() if of == setting]
    return growth([c["tetrahedra"] for c in costs], [c["cpu_s"] for c in costs])


def iteration(measured: Measured, step: Newton) -> float:
    """Mean CPU time of an iteration [s] in the beat with the mesh and the element of a Newton step."""
    setting = next(setting for setting, element in ELEMENTS.items() if element == step.element)
    beat = measured.beats[step.mesh, setting]
    return beat["cpu_s"] / max(beat["iterations"], 1.0)


def machine() -> str:
    """Processor and Python."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    model = next((line.split(":")[1].strip() for line in lines if line.startswith("model name")), "")
    return f"{model or platform.processor() or platform.machine()}, Python {platform.python_version()}"


def _beat_row(setting: str, cost: Cost) -> str:
    element = ELEMENTS[setting]
    unknowns = cost["nodes"] * (4 if element == "mixed" else 3)
    microseconds = 1e6 * cost["cpu_s"] / max(cost["iterations"], 1.0) / unknowns
    cells = [
        f"{cost['tetrahedra']:.0f}",
        f"`{element}`",
        f"{unknowns:.0f}",
        f"{cost['cpu_s']:.2f}",
        f"{microseconds:.2f}",
    ]
    cells += [f"{cost[name]:.0f}" for name in ("iterations", "factorisations")]
    failed = "" if cost["completed"] else " (failed)"
    return table_row(*cells, f"{cost['unloading_s']:.1f}", f"{cost['peak_mb']:.0f}{failed}")


def _newton_row(step: Newton, ours: Newton, iteration: float) -> str:
    times, other = step.times, step is not ours
    parts = [times["residual"], times.get("tangent"), times.get("factors"), times["solution"]]
    if not other:
        parts[1:3] = [times["tangent and factors"], None]
    milliseconds = [f"{1e3 * part:.1f}" if part is not None else "in tangent" for part in parts]
    ratios = (f"{step.total / ours.total:.1f} x", f"{step.total / iteration:.0f} x") if other else ("", "")
    cells = [step.mesh, f"`{step.element}`", step.solver, *milliseconds, f"{1e3 * step.total:.1f}"]
    cells += [f"{1e6 * step.total / step.unknowns:.1f}", *ratios]
    return table_row(*cells, f"{step.defects['direction']:.0e}" if other else "")
