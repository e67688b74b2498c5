"""Measurements of performance as tables: figures with targets, beats, Newton steps, a job and spheres."""

from collections.abc import Sequence
from dataclasses import dataclass

import pandas as pd

from benchmarks import sphere
from benchmarks.figure import Figure
from benchmarks.growth import growth
from benchmarks.job import Job
from benchmarks.newton import Newton

ELEMENTS = {"physical": "mixed", "locking": "p1"}
Cost = dict[str, float]


@dataclass(frozen=True)
class Measured:
    """All measurements of a run: beats by (mesh, setting), Newton steps, a job, spheres, the engine now and before."""

    beats: dict[tuple[str, str], Cost]
    newton: Sequence[Sequence[Newton]]
    job: Job
    spheres: dict[str, tuple[float, float]]
    engine: dict[str, float]
    before: dict[str, float]


def tables(measured: Measured, figures: Sequence[Figure]) -> dict[str, pd.DataFrame]:
    """Return the tables by name: figures with targets, beats, Newton steps, parts of a job, and spheres."""
    newton = [
        _newton_row(step, group[0], iteration(measured, step)) for group in measured.newton for step in group
    ]
    return {
        "targets": pd.DataFrame([figure.row() for figure in figures]),
        "beats": pd.DataFrame([_beat_row(setting, cost) for (_, setting), cost in measured.beats.items()]),
        "newton": pd.DataFrame(newton),
        "job": pd.DataFrame(_job_rows(measured), columns=["part of a job", "s"]),
        "spheres": pd.DataFrame(
            sphere.rows(measured.spheres), columns=["case", "CPU ms a beat", "CPU ms beside the beats"]
        ),
    }


def exponent(measured: Measured, setting: str) -> float:
    """Growth exponents of the CPU time with the number of tetrahedra."""
    costs = [cost for (_, of), cost in measured.beats.items() if of == setting]
    return growth([c["tetrahedra"] for c in costs], [c["cpu_s"] for c in costs])


def iteration(measured: Measured, step: Newton) -> float:
    """Mean CPU time of an iteration [s] in the beat with the mesh and the element of a Newton step."""
    setting = next(setting for setting, element in ELEMENTS.items() if element == step.element)
    beat = measured.beats[step.mesh, setting]
    return beat["cpu_s"] / max(beat["iterations"], 1.0)


def _job_rows(measured: Measured) -> list[tuple[str, str]]:
    job, smallest = measured.job, next(iter(measured.beats.values()))
    what = f"`heartfit simulate`, one beat of {smallest['tetrahedra']:.0f} tetrahedra, on the wall"
    seconds = {
        what: job.wall,
        "the same, CPU": job.cpu,
        "beat in a warm process": job.beat,
        "interpreter, imports, kernels and files": job.overhead,
        "Snakemake's first line, in a workflow": job.snakemake,
    }
    return [(name, f"{value:.2f}") for name, value in seconds.items()]


def _beat_row(setting: str, cost: Cost) -> dict[str, str]:
    element = ELEMENTS[setting]
    unknowns = cost["nodes"] * (4 if element == "mixed" else 3)
    microseconds = 1e6 * cost["cpu_s"] / max(cost["iterations"], 1.0) / unknowns
    return {
        "tets": f"{cost['tetrahedra']:.0f}",
        "element": f"`{element}`",
        "unknowns": f"{unknowns:.0f}",
        "CPU s": f"{cost['cpu_s']:.2f}",
        "µs per unknown and iteration": f"{microseconds:.2f}",
        "iterations": f"{cost['iterations']:.0f}",
        "factors": f"{cost['factorisations']:.0f}",
        "reference, CPU s": f"{cost['unloading_s']:.1f}",
        "MB": f"{cost['peak_mb']:.0f}{'' if cost['completed'] else ' (failed)'}",
    }


def _newton_row(step: Newton, ours: Newton, iteration: float) -> dict[str, str]:
    times, other = step.times, step is not ours
    parts = [times["residual"], times.get("tangent"), times.get("factors"), times["solution"]]
    if not other:
        parts[1:3] = [times["tangent and factors"], None]
    milliseconds = [f"{1e3 * part:.1f}" if part is not None else "in tangent" for part in parts]
    return {
        "mesh": step.mesh,
        "element": f"`{step.element}`",
        "program": step.solver,
        **dict(zip(("residual", "tangent", "factors", "solution"), milliseconds, strict=True)),
        "sum": f"{1e3 * step.total:.1f}",
        "µs": f"{1e6 * step.total / step.unknowns:.1f}",
        "ratio": f"{step.total / ours.total:.1f} x" if other else "",
        "in use": f"{step.total / iteration:.0f} x" if other else "",
        "left": f"{step.defects['direction']:.0e}" if other else "",
    }
