"""Comparison of calibration methods on spheres of known truth, and coverage of their intervals."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import islice

import numpy as np

from heartfit.calibration.alternatives import has_cma, iterate, minimise_by_cma_es, smooth_ensemble
from heartfit.calibration.design import CalibrationError, Design, Simplex
from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.sensitivity import covariance_of_fixed
from heartfit.calibration.unscented import STANDARD_DESIGN, CachedForward, CountedForward, Forward
from heartfit.core.arrays import Floats
from heartfit.observation.noise_model import Share
from heartfit.synthetic.known_hearts import WORLDS, KnownHeart, KnownHeartSampler, World
from heartfit.synthetic.volunteer import OTHER_SPREAD

INTERVAL_95 = 1.959964
"""Half-width of the 95 % interval of a Gaussian [standard deviations]."""
STEPS = 2
"""Steps of the repeated update where further parameters are unknown."""


@dataclass(frozen=True, eq=False)
class Coverage:
    """Errors of the estimates (hearts, n) [posterior standard deviations] for one noise assumption in one world.

    A failed calibration is a row of NaN and counts as not covered.
    """

    world: str
    noise: str
    names: tuple[str, ...]
    scores: Floats

    def shares(self) -> dict[str, Share]:
        """Return the share of hearts whose truth lies in the 95 % interval, by parameter."""
        covered = np.abs(self.scores) <= INTERVAL_95
        return {
            name: Share.from_count(float(column.sum()), len(column))
            for name, column in zip(self.names, covered.T, strict=True)
        }

    def pooled(self) -> Share:
        """Return the share over all parameters and hearts; hearts count as trials: errors within a heart correlate."""
        covered = np.abs(self.scores) <= INTERVAL_95
        return Share.from_count(float(covered.mean() * len(covered)), len(covered))


def sphere_coverage(sampler: KnownHeartSampler, hearts: int) -> list[Coverage]:
    """Count the coverage of one update by noise assumption and world; with other parameters unknown, also of two."""
    forward, fixed_part = CachedForward(sampler.model.observe_all), fixed_noise(sampler)
    return [
        coverage for world in WORLDS for coverage in _coverage_in(sampler, forward, fixed_part, hearts, world)
    ]


def _coverage_in(
    sampler: KnownHeartSampler, forward: Forward, fixed_part: Floats, hearts: int, world: World
) -> Iterator[Coverage]:
    drawn = [sampler.draw(number, world) for number in range(hearts)]
    assumptions: dict[str, tuple[Callable[[KnownHeart], Floats | None], int]] = {
        "R = 0": (lambda _: None, 1),
        "R of the measurement": (lambda heart: heart.noise, 1),
        "R and R_fixed": (lambda heart: heart.noise + fixed_part, 1),
    }
    if world == "parameters":
        assumptions[f"R and R_fixed, {STEPS} steps"] = (lambda heart: heart.noise + fixed_part, STEPS)
    for name, (noise, steps) in assumptions.items():
        scores = [_scores(sampler.prior, forward, heart, noise(heart), steps) for heart in drawn]
        yield Coverage(world, name, sampler.prior.names, np.array(scores))


def fixed_noise(sampler: KnownHeartSampler) -> Floats:
    """Return R_fixed (m, m) of the parameters that scatter but are not estimated, from slopes at the prior's mean."""
    sds = np.full(len(sampler.fixed), OTHER_SPREAD)
    return covariance_of_fixed(sampler.model.slopes(sampler.fixed, tuple(sampler.noise), OTHER_SPREAD), sds)


def _scores(prior: Gaussian, forward: Forward, heart: KnownHeart, noise: Floats | None, steps: int) -> Floats:
    try:
        *_, last = islice(iterate(prior, forward, heart.observed, noise), steps)
    except CalibrationError:
        return np.full(len(prior.names), np.nan)
    return (last.estimate.mean - heart.truth) / last.estimate.sd


ASSIMILATIONS = 4
"""Data assimilations of the ensemble smoother."""


@dataclass(frozen=True, eq=False)
class CalibrationProblem:
    """Forward model, prior, observations and noise covariance R (m, m) for a method; the truth (n,) for its score."""

    forward: Forward
    prior: Gaussian
    observed: Mapping[str, float]
    noise: Floats
    truth: Floats


@dataclass(frozen=True)
class MethodScore:
    """Errors of a method after a number of simulations; NaN for observations if the beat of its estimate fails.

    observations: mean unsigned relative error [%]; parameters: root mean square error [prior standard deviations].
    """

    heart: int
    method: str
    simulations: int
    observations: float
    parameters: float


@dataclass(frozen=True)
class Method:
    """Name, and successive estimates (n,) after increasing numbers of simulations of the forward model."""

    name: str
    estimates: Callable[[CalibrationProblem, Forward, int], Iterator[Floats]]


def methods(simulations: int, steps: int) -> list[Method]:
    """Return the prior, the published method and its alternatives with at most ``simulations`` simulations."""
    entries = [
        Method("prior", _prior),
        Method("unscented, R = 0", partial(_unscented, steps=steps, noise=False, design=STANDARD_DESIGN)),
        Method("unscented, R > 0", partial(_unscented, steps=steps, noise=True, design=STANDARD_DESIGN)),
        Method("simplex, R > 0", partial(_unscented, steps=steps, noise=True, design=Simplex())),
        Method("ensemble smoother", partial(_smooth, members=simulations // ASSIMILATIONS)),
    ]
    return entries + [Method("CMA-ES", _minimise)] * has_cma()


def compare_on_spheres(
    sampler: KnownHeartSampler, hearts: int, simulations: int, steps: int
) -> list[MethodScore]:
    """Score all methods on hearts whose model and other parameters are unknown to the calibrator."""
    forward, entered = CachedForward(sampler.model.observe_all), methods(simulations, steps)
    return [
        score
        for number in range(hearts)
        for score in compare_methods(_problem(sampler, forward, number), entered, simulations, number)
    ]


def _problem(sampler: KnownHeartSampler, forward: Forward, number: int) -> CalibrationProblem:
    heart = sampler.draw(number, "model")
    return CalibrationProblem(forward, sampler.prior, heart.observed, heart.noise, heart.truth)


def compare_methods(
    problem: CalibrationProblem, entered: Sequence[Method], simulations: int, heart: int = 0
) -> list[MethodScore]:
    """Score all methods on one heart; simulations that only evaluate an estimate are not counted.

    A method stops before it exceeds ``simulations``, or when too many of its simulations fail. heart: number of the
    heart, from which random methods derive their seeds.
    """
    return [score for method in entered for score in _method_scores(problem, method, simulations, heart)]


def _method_scores(
    problem: CalibrationProblem, method: Method, simulations: int, heart: int
) -> Iterator[MethodScore]:
    counted = CountedForward(problem.forward)
    try:
        for z in method.estimates(problem, counted, heart + 1):
            if counted.simulations > simulations:
                return
            yield MethodScore(heart, method.name, counted.simulations, *estimate_errors(problem, z))
    except CalibrationError:
        return


def estimate_errors(problem: CalibrationProblem, z: Floats) -> tuple[float, float]:
    """Errors of the observations and of the parameters, as in :class:`MethodScore`."""
    parameter_error = float(np.sqrt(np.mean(np.square((z - problem.truth) / problem.prior.sd))))
    outcome = problem.forward([problem.prior.physical(z)])[0]
    if isinstance(outcome, str):
        return np.nan, parameter_error
    relative = [abs(outcome[name] / value - 1.0) for name, value in problem.observed.items()]
    return 100.0 * float(np.mean(relative)), parameter_error


def _prior(problem: CalibrationProblem, forward: Forward, seed: int) -> Iterator[Floats]:  # noqa: ARG001
    yield problem.prior.mean


def _unscented(
    problem: CalibrationProblem,
    forward: Forward,
    seed: int,  # noqa: ARG001
    steps: int,
    noise: bool,
    design: Design,
) -> Iterator[Floats]:
    covariance = problem.noise if noise else None
    for posterior in islice(iterate(problem.prior, forward, problem.observed, covariance, design), steps):
        yield posterior.estimate.mean


def _smooth(problem: CalibrationProblem, forward: Forward, seed: int, members: int) -> Iterator[Floats]:
    drawn = smooth_ensemble(
        problem.prior, forward, problem.observed, problem.noise, members, seed, ASSIMILATIONS
    )
    yield drawn.mean(axis=0)


def _minimise(problem: CalibrationProblem, forward: Forward, seed: int) -> Iterator[Floats]:
    return minimise_by_cma_es(problem.prior, forward, problem.observed, problem.noise, seed)
