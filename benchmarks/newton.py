"""CPU time of our Newton step and of other programs on the same problem."""

import json
import sys
from dataclasses import dataclass
from pathlib import Path

from benchmarks.newton_problem import step_of, write_problem
from benchmarks.peers.clock import median_cpu
from benchmarks.process import PYTHON, ask
from benchmarks.ventricles import FOLDER, ROOT, mesh_file
from heartfit.io.meshes import read_mesh

PEERS = ("scikit_fem", "ngsolve")
TOLERANCES = {"residual": 1e-9, "tangent": 1e-6}
"""Largest accepted relative differences; our tangent is compared by differences of forces."""


@dataclass(frozen=True)
class Newton:
    """CPU times of the parts of a Newton step [s], and deviations of a program's results from ours."""

    mesh: str
    element: str
    solver: str
    unknowns: int
    times: dict[str, float]
    defects: dict[str, float]

    @property
    def total(self) -> float:
        """Time of residual, tangent, factorisation and solution [s]."""
        return sum(self.times.values())


def newton_steps(mesh: str, element: str) -> list[Newton]:
    """Return our step, then those of the others; raises RuntimeError if a program solves another problem."""
    problem = FOLDER / "problems" / f"{mesh}_{element}.npz"
    problem.parent.mkdir(parents=True, exist_ok=True)
    wall = read_mesh(mesh_file(mesh))
    write_problem(problem, wall, element)
    unknowns = len(wall.points) * (4 if element == "mixed" else 3)
    answers = [ask("-m", "benchmarks.newton", mesh_file(mesh), element)]
    answers += [
        ask(ROOT / "benchmarks/peers" / f"{peer}_newton.py", problem, python=PYTHON) for peer in PEERS
    ]
    steps = [Newton(mesh, element, unknowns=unknowns, **answer) for answer in answers]
    for step in steps[1:]:
        _require_same(step)
    return steps


def _require_same(step: Newton) -> None:
    if not all(step.defects[name] < largest for name, largest in TOLERANCES.items()):
        raise RuntimeError(
            f"{step.solver}, {step.mesh}, {step.element}: differs by {step.defects} relative to ours; "
            f"expected below {TOLERANCES}: not the same problem"
        )


def main(mesh: str, element: str) -> None:
    """Print the times of our step."""
    step, x = step_of(read_mesh(Path(mesh)), element)
    residual_s, residual = median_cpu(lambda: step.forces(x))
    tangent_s, factor = median_cpu(lambda: step.tangent(x))
    solve_s, _ = median_cpu(lambda: factor.solve(residual))
    times = {"residual": residual_s, "tangent and factors": tangent_s, "solution": solve_s}
    print(json.dumps({"solver": "heartfit", "times": times, "defects": {}}))


if __name__ == "__main__":
    main(*sys.argv[1:])
