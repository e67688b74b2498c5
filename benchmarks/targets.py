"""Targets of the figures, and attempts for missed targets."""

import math
from collections.abc import Sequence

from benchmarks import sphere
from benchmarks.figure import Figure
from benchmarks.newton import Newton
from benchmarks.page import ELEMENTS, Measured, exponent

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

BEAT = (
    "A beat: at 10k a quarter is residuals, a quarter solutions with kept factors, a fifth new factors; at 3k a good "
    "part is Python between the kernels. What brought it down from 6.7 s is in decision 6, what was done and tried "
    "since, with steps of varying length, in decision 48."
)
SHARE = (
    "A Newton step: ours is mostly its factors, which the engine renews a few times in a beat; in use it is faster "
    "by the ratios of that column."
)
START = (
    "A job: numba alone takes the 0.6 s that are asked for, with the numpy and the part of scipy that it needs: 0.25 s "
    "to import, 0.18 s to set up its types, 0.17 s to load some thirty kept kernels. Our modules, the validation and "
    "meshio take 0.2 s. Pandas, scipy.signal, scipy.sparse, scipy.optimize, scikit-fem and the mesher are imported no "
    "longer, versions are not read, imports not parsed; less would take kernels that load without numba."
)
SEARCH = (
    "A search: 25000 beats of spheres in 7700 hearts, of which 6800 are columns of a Jacobian that take about three "
    "beats of one iteration a step from their centre, are half of it; hearts amended and observed in Python the rest. "
    "Fewer beats do not suffice, see decision 49. Before it were 33000 beats of two iterations."
)
TRIED = {"job": START, "search": SEARCH}


def figures(measured: Measured) -> list[Figure]:
    """Return all figures with targets."""
    engine = [
        Figure(name, measured.engine[key], most, "CPU s", tried=TRIED.get(key, BEAT), before=before)
        for key, (name, most) in ENGINE.items()
        for before in [measured.before.get(key, math.nan)]
    ]
    growths = [
        Figure(f"growth, `{ELEMENTS[setting]}`", exponent(measured, setting), GROWTH, "exponent", tried=BEAT)
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
            tried=SHARE,
        )
        for other in others
        for program in [other.solver.split()[0]]
    ]
