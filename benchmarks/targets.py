"""Targets of the figures, and attempts for missed targets."""

from collections.abc import Sequence

from benchmarks import sphere
from benchmarks.figure import Figure
from benchmarks.newton import Newton
from benchmarks.page import ELEMENTS, Measured, exponent

LARGEST = {"3k": 0.6, "10k": 2.5}
"""CPU time of a beat [s], `mixed`."""
GROWTH, OVERHEAD = 1.3, 0.6
FASTER = {"scikit-fem": 20.0, "NGSolve": 10.0}

BEAT = (
    "A beat: at 10k a residual with the fibres' own equation takes 2.2 ms and a solution 2 ms within the beat, 1.9 "
    "and 0.9 ms alone, so they drive each other's data from the cache; at 3k a good part is Python between the "
    "kernels. What brought it down from 6.7 s, and what did not, is in decision 6; steps of varying length were not "
    "tried."
)
SHARE = (
    "A Newton step: ours is mostly its factors, which the engine renews a few times in a beat; in use it is faster "
    "by the ratios of that column."
)
START = (
    "A job: of it numba, numpy and scipy take 0.45 s to import, our modules and the validation 0.2 s, numba's set-up "
    "and some thirty kept kernels 0.35 s to load, the fingerprint of the code 0.1 s. Pandas, scipy.signal, "
    "scipy.optimize, scikit-fem and the mesher, 0.7 s, are imported no longer; less would take kernels "
    "that load without numba."
)


def figures(measured: Measured) -> list[Figure]:
    """Return all figures with targets."""
    beats = [
        Figure(
            f"beat of {mesh}, `mixed`", measured.beats[mesh, "physical"]["cpu_s"], most, "CPU s", tried=BEAT
        )
        for mesh, most in LARGEST.items()
        if (mesh, "physical") in measured.beats
    ]
    growths = [
        Figure(f"growth, `{ELEMENTS[setting]}`", exponent(measured, setting), GROWTH, "exponent", tried=BEAT)
        for setting in ELEMENTS
    ]
    ratios = [figure for group in measured.newton for figure in _ratios(group)]
    start = Figure("one job beside its beat", measured.job.overhead, OVERHEAD, "CPU s", tried=START)
    return [*beats, *growths, *ratios, start, *sphere.figures(measured.spheres)]


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
