"""Methods of calibration beside each other: how near they come for how many simulations."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice

import numpy as np

from heartfit.calibration.design import CalibrationError, Design
from heartfit.calibration.evolution import evolved
from heartfit.calibration.evolution import installed as evolution_installed
from heartfit.calibration.forward import Counted, Forward, Remembered
from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.iterated import iterated
from heartfit.calibration.simplex import Simplex
from heartfit.calibration.smoother import smoothed
from heartfit.calibration.unscented import STANDARD
from heartfit.geometry.arrays import Floats
from heartfit.twins.draw import Twins

ASSIMILATIONS = 4


@dataclass(frozen=True, eq=False)
class Problem:
    """What a method is given: model, prior, observations and R (m, m); and the truth (n,), by which it is judged."""

    forward: Forward
    prior: Gaussian
    observed: Mapping[str, float]
    noise: Floats
    truth: Floats


@dataclass(frozen=True)
class Mark:
    """Where a method stands after some simulations; errors are NaN if its estimate has no beat.

    observations: mean unsigned relative error, %; parameters: root mean square error in standard deviations of the
    prior.
    """

    heart: int
    method: str
    simulations: int
    observations: float
    parameters: float


@dataclass(frozen=True)
class Method:
    """A name and the estimates (n,), each after more simulations of the forward model than the one before."""

    name: str
    estimates: Callable[[Problem, Forward, int], Iterator[Floats]]


def methods(simulations: int, steps: int) -> list[Method]:
    """The prior, what was published, and what else one could do with at most so many simulations."""
    found = [
        Method("prior", _prior),
        Method("unscented, R = 0", partial(_unscented, steps=steps, noise=False, design=STANDARD)),
        Method("unscented, R > 0", partial(_unscented, steps=steps, noise=True, design=STANDARD)),
        Method("simplex, R > 0", partial(_unscented, steps=steps, noise=True, design=Simplex())),
        Method("ensemble smoother", partial(_smoothed, members=simulations // ASSIMILATIONS)),
    ]
    return found + [Method("CMA-ES", _evolved)] * evolution_installed()


def race_twins(twins: Twins, hearts: int, simulations: int, steps: int) -> list[Mark]:
    """The marks of all methods on hearts whose model and other parameters the calibrator does not know."""
    forward, entered = Remembered(twins.model), methods(simulations, steps)
    return [
        mark
        for number in range(hearts)
        for mark in race(_problem(twins, forward, number), entered, simulations, number)
    ]


def _problem(twins: Twins, forward: Forward, number: int) -> Problem:
    twin = twins.draw(number, "model")
    return Problem(forward, twins.prior, twin.observed, twin.noise, twin.truth)


def race(problem: Problem, entered: Sequence[Method], simulations: int, heart: int = 0) -> list[Mark]:
    """The marks of all methods on one heart; the beats that only show where an estimate stands are not counted.

    A method is stopped before it exceeds ``simulations``, or where too many of its own fail. heart: its number, from
    which the seeds of methods that draw follow.
    """
    return [mark for method in entered for mark in _marks(problem, method, simulations, heart)]


def _marks(problem: Problem, method: Method, simulations: int, heart: int) -> Iterator[Mark]:
    counted = Counted(problem.forward)
    try:
        for z in method.estimates(problem, counted, heart + 1):
            if counted.simulations > simulations:
                return
            yield Mark(heart, method.name, counted.simulations, *errors(problem, z))
    except CalibrationError:
        return


def errors(problem: Problem, z: Floats) -> tuple[float, float]:
    """Errors of the observations and of the parameters, as in :class:`Mark`, of an estimate (n,)."""
    off = float(np.sqrt(np.mean(np.square((z - problem.truth) / problem.prior.sd))))
    outcome = problem.forward([problem.prior.physical(z)])[0]
    if isinstance(outcome, str):
        return np.nan, off
    apart = [abs(outcome[name] / value - 1.0) for name, value in problem.observed.items()]
    return 100.0 * float(np.mean(apart)), off


def _prior(problem: Problem, forward: Forward, seed: int) -> Iterator[Floats]:  # noqa: ARG001
    yield problem.prior.mean


def _unscented(
    problem: Problem,
    forward: Forward,
    seed: int,  # noqa: ARG001
    steps: int,
    noise: bool,
    design: Design,
) -> Iterator[Floats]:
    known = problem.noise if noise else None
    for posterior in islice(iterated(problem.prior, forward, problem.observed, known, design), steps):
        yield posterior.estimate.mean


def _smoothed(problem: Problem, forward: Forward, seed: int, members: int) -> Iterator[Floats]:
    drawn = smoothed(problem.prior, forward, problem.observed, problem.noise, members, seed, ASSIMILATIONS)
    yield drawn.mean(axis=0)


def _evolved(problem: Problem, forward: Forward, seed: int) -> Iterator[Floats]:
    return evolved(problem.prior, forward, problem.observed, problem.noise, seed)
