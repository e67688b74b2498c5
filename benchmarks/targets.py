"""Targets of the figures of performance."""

import math
from collections.abc import Sequence

from benchmarks import sphere
from benchmarks.figure import Figure
from benchmarks.newton import Newton
from benchmarks.performance import ELEMENTS, Measured, exponent

ENGINE = {
    "beat, 3k": ("beat of 3k, `mixed`", 0.5),
    "beat, 10k": ("beat of 10k, `mixed`", 2.0),
    "three beats, 3k": ("three beats of 3k", math.inf),
    "three beats, 10k": ("three beats of 10k", math.inf),
    "reference, 3k": ("stress-free reference of 3k", math.inf),
    "reference, 10k": ("stress-free reference of 10k", math.inf),
    "job": ("one job beside its beat", 0.6),
    "search": ("search for the cause of a planted leak", 6.0),
}
"""Names of the costs of :mod:`benchmarks.engine`, and their largest CPU time [s]."""
GROWTH = 1.3
FASTER = {"scikit-fem": 20.0, "NGSolve": 10.0}


def figures(measured: Measured) -> list[Figure]:
    """Return all figures with targets."""
    engine = [
        Figure(name, measured.engine[key], most, "CPU s", before=before)
        for key, (name, most) in ENGINE.items()
        for before in [measured.before.get(key, math.nan)]
    ]
    growths = [
        Figure(f"growth, `{ELEMENTS[setting]}`", exponent(measured, setting), GROWTH, "exponent")
        for setting in ELEMENTS
    ]
    ratios = [figure for group in measured.newton for figure in _ratios(group)]
    before = measured.before.get("sphere", math.nan)
    return [*engine, *growths, *ratios, *sphere.figures(measured.spheres, before)]


def _ratios(group: Sequence[Newton]) -> list[Figure]:
    ours, *others = group
    return [
        Figure(
            f"Newton step, {ours.mesh}, `{ours.element}`, beside {program}",
            other.total / ours.total,
            FASTER[program],
            "times faster",
            at_least=True,
        )
        for other in others
        for program in [other.solver.split()[0]]
    ]
