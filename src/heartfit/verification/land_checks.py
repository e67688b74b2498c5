"""The benchmark of cardiac mechanics: rows for coarse meshes, which every test run affords, and for the finest."""

from heartfit.verification.check import Check
from heartfit.verification.land import PROBLEMS, VOLUME, Problem, Size

COARSE, FINE = 5.0, 1.0
"""Tolerances, %: that of the coarse mesh is its discretisation error."""

SOURCE = "Land et al. 2015, Simula-FEniCS"


def coarse_land_checks() -> list[Check]:
    """On the coarsest meshes, 2 s of computing."""
    return [row for problem in PROBLEMS for row in _rows(problem, problem.sizes[0], COARSE)]


def fine_land_checks() -> list[Check]:
    """On the finest meshes, half a minute of computing."""
    return [row for problem in PROBLEMS for row in _rows(problem, problem.sizes[-1], FINE)]


def land_table() -> str:
    """What the meshes give, coarse to fine, and how far that is from what is expected."""
    return "".join(_line(problem, name) for problem in PROBLEMS for name in problem.expected)


def _rows(problem: Problem, size: Size, tolerance: float) -> list[Check]:
    asked = [name for name in problem.expected if name != VOLUME]
    named = {f"{problem.title}: {name.rsplit(',', 1)[0]} off, {_mesh(size)}": name for name in asked}
    return [
        Check(row, problem.deviation(name, size), 0.0, tolerance, "%", SOURCE) for row, name in named.items()
    ]


def _line(problem: Problem, name: str) -> str:
    cells = [
        f"{problem.answers(size)[name]:.2f} ({problem.deviation(name, size):+.1f} %)"
        for size in problem.sizes
    ]
    return f"| {problem.title} | {name} | {' | '.join(cells)} | {problem.expected[name]:.2f} |\n"


def _mesh(size: Size) -> str:
    return " x ".join(map(str, size))
