"""Run all benchmarks and store docs/measured/performance_*.tsv; `--small` omits the meshes above 10k tetrahedra.

`--before COMMIT` measures the engine of an earlier version in the same run.
"""

import sys
from collections.abc import Callable
from functools import partial
from typing import TypeVar

from benchmarks import sphere
from benchmarks.beat import cost
from benchmarks.engine import costs_in_turn
from benchmarks.job import job
from benchmarks.measured_table import store_table
from benchmarks.newton import newton_steps
from benchmarks.performance import ELEMENTS, Measured, tables
from benchmarks.process import ask, install_peers
from benchmarks.targets import figures
from benchmarks.ventricles import mesh_file
from heartfit.synthetic.kernels import compile_kernels

SMALL, ALL = ("3k", "10k"), ("3k", "10k", "30k", "100k")
T = TypeVar("T")


def main(arguments: list[str]) -> None:
    meshes = SMALL if "--small" in arguments else ALL
    announced("installing the other programs", install_peers)
    announced("compiling the kernels", compile_kernels)
    for mesh in meshes:
        announced(f"mesh of {mesh} tetrahedra", partial(mesh_file, mesh))
    beats = {
        (mesh, setting): announced(f"beat of {mesh}, {setting}", partial(cost, mesh, setting))
        for mesh in meshes
        for setting in ELEMENTS
    }
    steps = [
        announced(f"Newton steps on {mesh}, {element}", partial(newton_steps, mesh, element))
        for mesh in SMALL
        for element in ELEMENTS.values()
    ]
    one = announced("one job", lambda: job("3k", "physical"))
    spheres = announced("spheres", sphere.costs)
    commit = arguments[arguments.index("--before") + 1] if "--before" in arguments else ""
    before, now = (
        announced(f"engine of {commit} and now", lambda: costs_in_turn(commit))
        if commit
        else ({}, announced("engine", lambda: ask("-m", "benchmarks.engine")))
    )
    measured = Measured(beats, steps, one, spheres, now, before)
    for name, table in tables(measured, figures(measured)).items():
        store_table(f"performance_{name}", table, " ".join(("benchmarks", *arguments)))


def announced(what: str, work: Callable[[], T]) -> T:
    """Print the name of a measurement, run it and print its result."""
    sys.stdout.write(f"{what} ... ")
    sys.stdout.flush()
    result = work()
    sys.stdout.write(f"{result if isinstance(result, dict) else 'done'}\n")
    return result


if __name__ == "__main__":
    main(sys.argv[1:])
