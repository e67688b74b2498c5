"""Measurements that every peer prints."""

import json
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

REPEATS = 5


@dataclass(frozen=True)
class Problem:
    """The arrays of `benchmarks.newton_problem.write_problem`; x (n, dofs)."""

    points: np.ndarray
    tets: np.ndarray
    fibres: np.ndarray
    held: np.ndarray
    moduli: np.ndarray
    x: np.ndarray
    residual: np.ndarray
    direction: np.ndarray
    probe: np.ndarray
    derivative: np.ndarray

    @property
    def free(self) -> np.ndarray:
        """Mask (n, dofs) of the unknowns that are solved for."""
        mask = np.ones(self.x.shape, dtype=bool)
        mask[self.held, :3] = False
        return mask


def read_problem() -> Problem:
    """The problem in the file that the command line names."""
    return Problem(**np.load(sys.argv[1]))


def median_cpu(work: Callable[[], Any]) -> tuple[float, Any]:
    """Median CPU time of a few runs after a first one, s, and what the last one returned."""
    times, result = [], work()
    for _ in range(REPEATS):
        begin = time.process_time()
        result = work()
        times.append(time.process_time() - begin)
    return float(np.median(times)), result


def say(
    problem: Problem, times: dict[str, float], residual: np.ndarray, images: list[np.ndarray], solver: str
) -> None:
    """Print times and how far the answers are from ours; images (n, dofs): the tangent on probe and direction."""
    defects = {
        "residual": _relative(residual, problem.residual, problem),
        "tangent": _relative(images[0], problem.derivative, problem),
        "direction": _relative(images[1], problem.residual, problem),
    }
    print(json.dumps({"solver": solver, "times": times, "defects": defects}))


def _relative(theirs: np.ndarray, ours: np.ndarray, problem: Problem) -> float:
    """The worse of forces and wall-pressure equations, each over its own norm."""
    parts = []
    for part in (slice(None, 3), slice(3, None)):
        free = problem.free[:, part]
        if free.size:
            difference = (theirs - ours)[:, part][free]
            parts.append(np.linalg.norm(difference) / np.linalg.norm(ours[:, part][free]))
    return float(max(parts))
