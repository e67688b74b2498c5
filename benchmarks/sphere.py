"""Compiled beat of spheres, alone and compared with PhysioBlocks on its case: `python -m benchmarks.sphere`."""

import math
import time
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np

from benchmarks.figure import Figure
from benchmarks.process import PYTHON, ask, install_peers
from benchmarks.ventricles import ROOT
from heartfit.core.arrays import Floats
from heartfit.heart.beat import Beat
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import HEALTHY_ACTIVATION, Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from verification.physioblocks import departure, reference_beat

LEFT, RIGHT = Sphere.from_volumes(80e-6, 130e-6), Sphere.from_volumes(90e-6, 45e-6)
CASES = {
    "left ventricle, 1 fibre class": ([LEFT], np.array([0.03])),
    "left ventricle, 8 fibre classes": ([LEFT], HEALTHY_ACTIVATION),
    "both ventricles, 8 fibre classes each": ([LEFT, RIGHT], HEALTHY_ACTIVATION),
}
REPEATS, SMALL, MANY = 100, 5, 25
THEIRS = "PhysioBlocks, reference case of 1000 steps a beat"
OURS = "ours, the same case"
TOLERANCE = 0.02
"""Largest relative L2 deviation of volume and pressure; the tests also apply it to their rates."""


def cost(run: Callable[[int], Beat]) -> tuple[float, float]:
    """CPU time of an additional beat and of the overhead of a run [s]: medians, with compiled kernels."""
    few, many = (_median(partial(run, n)) for n in (SMALL, MANY))
    beat = (many - few) / (MANY - SMALL)
    return beat, few - SMALL * beat


def _median(work: Callable[[], Beat]) -> float:
    times = []
    for _ in range(REPEATS + 1):
        begin = time.process_time()
        if not work().completed:
            raise RuntimeError("a sphere of the benchmark failed")
        times.append(time.process_time() - begin)
    return float(np.median(times[1:]))


def standard(spheres: Sequence[Sphere], activation: Floats, beats: int) -> Beat:
    """Simulate a number of beats of the standard heart at 5 ms, without the criterion of periodicity."""
    heart = Heart().with_parameters({"sigma_0": 150e3})
    return simulate_spheres(heart, spheres, Numerics(max_beats=beats, drift=0.0), activation)


def costs() -> dict[str, tuple[float, float]]:
    """CPU time of a beat and of the overhead [s], by case; PhysioBlocks has one number."""
    ours = {name: cost(partial(standard, *case)) for name, case in CASES.items()}
    theirs = physioblocks()
    differences = departures(theirs, reference_beat())
    if max(differences.values()) > TOLERANCE:
        raise RuntimeError(f"ours and theirs are not the same case: they depart by {differences}")
    return ours | {
        OURS: cost(lambda n: reference_beat(beats=n, drift=0.0)),
        THEIRS: (theirs["cpu_s_a_beat"], 0.0),
    }


def physioblocks() -> dict[str, Any]:
    """CPU time of a beat of PhysioBlocks in its environment [s], and its last cycle."""
    return ask(ROOT / "benchmarks" / "peers" / "physioblocks_beat.py", python=PYTHON)


def departures(theirs: dict[str, Any], ours: Beat) -> dict[str, float]:
    """Relative L2 deviations of our volume and pressure from theirs."""
    curves = {"volume": ours.volume["lv"], "pressure": ours.pressure["lv"]}
    return {name: departure(curve, np.array(theirs[name])) for name, curve in curves.items()}


def figures(measured: dict[str, tuple[float, float]], before: float = math.nan) -> list[Figure]:
    """Return the figures with targets; ``before`` is the beat of an earlier version [s]."""
    first, ratio = measured[next(iter(CASES))][0], measured[THEIRS][0] / measured[OURS][0]
    return [
        Figure(
            "beat of a sphere, 172 steps, 1 fibre class",
            1e3 * first,
            0.12,
            "CPU ms",
            before=1e3 * before,
        ),
        Figure("sphere beside PhysioBlocks, its own case", ratio, 1000.0, "times faster", at_least=True),
    ]


def rows(measured: dict[str, tuple[float, float]]) -> list[tuple[str, str, str]]:
    """Name, CPU time of a beat [ms], CPU time of the overhead [ms]."""
    return [(name, f"{1e3 * beat:.3f}", f"{1e3 * beside:.2f}") for name, (beat, beside) in measured.items()]


if __name__ == "__main__":
    install_peers()
    figures_of_cost = costs()
    for row in (
        *rows(figures_of_cost),
        *((figure.name, f"{figure.measured:.3g} {figure.unit}", "") for figure in figures(figures_of_cost)),
    ):
        print("{:<55} {:>14} {:>8}".format(*row))
