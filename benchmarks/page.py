"""The page of performance, in Markdown: every figure beside its target, then the tables they come from."""

import platform
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from benchmarks import sphere
from benchmarks.figure import Figure
from benchmarks.growth import growth
from benchmarks.job import Job
from benchmarks.newton import Newton

ELEMENTS = {"physical": "mixed", "paper": "p1"}
Cost = dict[str, float]

HEADER = """# Performance

What a beat costs, on one thread, in CPU seconds: medians, kernels compiled. This page is written by
`python3 study.py benchmark` on {machine}; ratios of figures measured in one run carry over to other
machines, seconds do not. The first run also fills the wall with up to 100k tetrahedra and installs the other
programs, apart from the study.

| figure | measured | target | unit | |
|---|---|---|---|---|
"""

BEATS = """
## Beats

The first beat of the study's two settings (`physical`: `mixed`, `paper`: `p1`) at {step:g} ms on parametric
ventricles, from their stress-free reference, filling included; finding the reference stands in a column of its
own. Memory is the peak of the process. CPU seconds grow with the number of tetrahedra to the power of {growths}.

| tets | element | unknowns | CPU s | µs per unknown and iteration | iterations | factors | reference, CPU s | MB |
|---|---|---|---|---|---|---|---|---|
"""

NEWTON = """
## Newton step

One full Newton step of the same wall in other programs: Mooney-Rivlin law, fibres of constant tension, base held,
the same deformed state; `mixed` is the same stabilised element everywhere. CPU ms of residual, tangent, factors and
solution; µs per unknown. All residuals agree to 1e-9 or better, all tangents to 1e-6; "left" is what remains of the
residual where the other's tangent is applied to our Newton direction: our factors are in single precision, as a
direction needs no more. "ratio" compares full steps. The engine keeps its factors over many steps; "in use" divides
the full step of the others, which is what they do as they come, by the mean time of an iteration in our beat, with
everything that belongs to it: fibres, circuit, factors now and then.

| mesh | element | program | residual | tangent | factors | solution | sum | µs | ratio | in use | left |
|---|---|---|---|---|---|---|---|---|---|---|---|
"""

JOB = """
## One job

`heartfit simulate` on {tetrahedra:.0f} tetrahedra, one beat from a given reference: {wall:.2f} s from start to
end, {cpu:.2f} CPU s, of which a warm process takes {beat:.2f} s for the beat. The rest, {overhead:.2f} s, is the
interpreter, imports, loading the compiled kernels, and files. A job of the workflow adds {snakemake:.2f} s for
Snakemake's own first line. The workflow compiles the kernels in one job, `compile_kernels`, which every job with a
beat waits for.
"""

SPHERES = """
## Spheres

Beats of the compiled spheres at 5 ms unless said otherwise; what a call from Python takes stands beside them. The
departure of ours from PhysioBlocks on its own reference case is on the page of verification.

| case | CPU ms a beat | CPU ms beside the beats |
|---|---|---|
"""


@dataclass(frozen=True)
class Measured:
    """Everything that is measured in a run: beats by (mesh, setting), Newton steps, a job, spheres."""

    beats: dict[tuple[str, str], Cost]
    newton: Sequence[Sequence[Newton]]
    job: Job
    spheres: dict[str, tuple[float, float]]
    time_step: float


def page(measured: Measured, figures: Sequence[Figure]) -> str:
    """The page."""
    growths = " and ".join(f"{exponent(measured, s):.2f} (`{ELEMENTS[s]}`)" for s in ELEMENTS)
    smallest = next(iter(measured.beats.values()))
    return "".join(
        [
            HEADER.format(machine=machine()),
            *(figure.row() for figure in figures),
            _missed(figures),
            BEATS.format(step=1e3 * measured.time_step, growths=growths),
            *(_beat_row(setting, cost) for (_, setting), cost in measured.beats.items()),
            NEWTON,
            *(
                _newton_row(each, group[0], iteration(measured, each))
                for group in measured.newton
                for each in group
            ),
            JOB.format(
                tetrahedra=smallest["tetrahedra"], overhead=measured.job.overhead, **vars(measured.job)
            ),
            SPHERES,
            *map(_row, sphere.rows(measured.spheres)),
        ]
    )


def exponent(measured: Measured, setting: str) -> float:
    """Growth of CPU seconds with the tetrahedra."""
    costs = [cost for (_, of), cost in measured.beats.items() if of == setting]
    return growth([c["tetrahedra"] for c in costs], [c["cpu_s"] for c in costs])


def iteration(measured: Measured, step: Newton) -> float:
    """Mean CPU s of an iteration in the beat on the mesh and with the element of a Newton step."""
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
    each = 1e6 * cost["cpu_s"] / max(cost["iterations"], 1.0) / unknowns
    cells = [
        f"{cost['tetrahedra']:.0f}",
        f"`{element}`",
        f"{unknowns:.0f}",
        f"{cost['cpu_s']:.2f}",
        f"{each:.2f}",
    ]
    cells += [f"{cost[name]:.0f}" for name in ("iterations", "factorisations")]
    failed = "" if cost["completed"] else " (failed)"
    return _row([*cells, f"{cost['unloading_s']:.1f}", f"{cost['peak_mb']:.0f}{failed}"])


def _missed(figures: Iterable[Figure]) -> str:
    reasons = dict.fromkeys(figure.tried for figure in figures if figure.tried and not figure.met)
    title = "\n## What was tried where a target is missed\n\n"
    return title * bool(reasons) + "".join(f"- {each}\n" for each in reasons)


def _newton_row(step: Newton, ours: Newton, iteration: float) -> str:
    times, other = step.times, step is not ours
    parts = [times["residual"], times.get("tangent"), times.get("factors"), times["solution"]]
    if not other:
        parts[1:3] = [times["tangent and factors"], None]
    milliseconds = [f"{1e3 * part:.1f}" if part is not None else "in tangent" for part in parts]
    ratios = (f"{step.total / ours.total:.1f} x", f"{step.total / iteration:.0f} x") if other else ("", "")
    cells = [step.mesh, f"`{step.element}`", step.solver, *milliseconds, f"{1e3 * step.total:.1f}"]
    cells += [f"{1e6 * step.total / step.unknowns:.1f}", *ratios]
    return _row([*cells, f"{step.defects['direction']:.0e}" if other else ""])


def _row(cells: Iterable[str]) -> str:
    return f"| {' | '.join(cells)} |\n"
