r"""An extension fitted to samples by repeated unscented steps with noise.

The points of the first step lie about the centre of the priors, the mechanism switched on, closer together than the
prior: what is far from the data says little of the slopes near them. Of all hearts that were simulated on the way the
estimate is the one of least

.. math:: \tfrac12 r^T R^{-1} r + \tfrac12 |x|^2 .

Steps end when one moves this by less than 0.5, or at their most; what still moves then has not converged. The
covariance C is that of the last step, whose points are the closest. By Laplace's approximation

.. math:: \ln Z = -\tfrac12 r^T R^{-1} r - \tfrac12 |x|^2 + \tfrac12 \ln |C|
          + \sum_{a \ge 0} \ln 2 \Phi(x_a / \sigma_a) + \mathrm{const}

compares extensions that were fitted to the same samples; the sum is over amplitudes whose sign is known.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from heartfit.beat import Beat
from heartfit.calibration.forward import Forward, Outcome, Remembered
from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.iterated import iterated
from heartfit.calibration.update import Posterior
from heartfit.geometry.arrays import Floats
from heartfit.observation.beat import beat_curves
from heartfit.proof.extension import Extension
from heartfit.proof.split import Sampled, sampled, stacked

SPREAD = 0.5
"""Of the first step's points, over the prior's."""
SETTLED = 0.5
"""What a step has to move the objective by for another one to follow: less moves no verdict."""

Run = Callable[[Extension, Mapping[str, float]], Beat]
"""From an extended setting and all its parameters, by name and SI, to a beat."""


@dataclass(frozen=True, eq=False)
class Target:
    """What is fitted: samples (n,) and the covariance (n, n) of a right model about them."""

    samples: Sampled
    covariance: Floats

    def values(self) -> Floats:
        """The samples one after the other (n,)."""
        return stacked({name: samples.values for name, samples in self.samples.items()})

    def misfit(self, predicted: Floats) -> float:
        """r^T R^-1 r."""
        residual = self.values() - predicted
        return float(residual @ np.linalg.solve(self.covariance, residual))


@dataclass(frozen=True, eq=False)
class Refit:
    """Names (d,), estimate x (d,) and covariance (d, d) of an extension's coordinates, and its parameters there, SI.

    misfit: r^T R^-1 r of n samples at the estimate; objective: what was minimised; log_evidence: up to a constant of
    the samples; simulations: beats it took; converged: whether the last step hardly lowered the objective.
    """

    names: tuple[str, ...]
    estimate: Floats
    covariance: Floats
    parameters: Mapping[str, float]
    misfit: float
    objective: float
    log_evidence: float
    samples: int
    simulations: int
    converged: bool

    @property
    def sd(self) -> Floats:
        """Standard deviations (d,) of the coordinates."""
        return np.sqrt(np.diag(self.covariance))


def refit(extension: Extension, run: Run, target: Target, most: int, amplitude: float = 1.0) -> Refit:
    """The refit after as many steps as it takes, or ``most``; CalibrationError where too many beats about one fail.

    amplitude: of the mechanism at the first step's centre, in its scales.
    """
    prior, seen = extension.prior(), _Seen(extension, run, target)
    names = [str(index) for index in range(target.values().size)]
    observed = dict(zip(names, target.values().tolist(), strict=True))
    start = Gaussian(prior.names, extension.start(amplitude), SPREAD**2 * prior.covariance)
    forward = Remembered(seen)
    walk = iterated(prior, forward, observed, target.covariance, start=start)
    covariance, converged = _settled(islice(walk, most), forward, seen)
    objective, x, misfit = seen.best
    return Refit(
        extension.names,
        x,
        covariance,
        extension.parameters(x),
        misfit,
        objective,
        _log_evidence(objective, x, covariance, extension.one_sided),
        target.values().size,
        seen.simulations,
        converged,
    )


def _settled(steps: Iterator[Posterior], forward: Forward, seen: "_Seen") -> tuple[Floats, bool]:
    """The covariance of the last step that was taken, and whether it left the objective where it was."""
    before, converged = np.inf, False
    for step in steps:
        (outcome,) = forward([step.estimate.physical()])
        after = np.inf if isinstance(outcome, str) else seen.seen[-1][0]
        covariance, converged, before = step.estimate.covariance, abs(before - after) < SETTLED, after
        if converged:
            break
    return covariance, converged


def _log_evidence(objective: float, x: Floats, covariance: Floats, one_sided: np.ndarray) -> float:
    from scipy.special import log_ndtr

    beyond = log_ndtr(x / np.sqrt(np.diag(covariance))) + np.log(2.0)
    return float(-objective + 0.5 * np.linalg.slogdet(covariance)[1] + beyond[one_sided].sum())


class _Seen:
    """The forward model of an extension; a calibration's positive parameters are the exponentials of coordinates."""

    def __init__(self, extension: Extension, run: Run, target: Target) -> None:
        self.extension, self.run, self.target = extension, run, target
        self.seen: list[tuple[float, Floats, float]] = []
        self.simulations = 0

    @property
    def best(self) -> tuple[float, Floats, float]:
        """Objective, coordinates and misfit of the heart of least objective."""
        return min(self.seen, key=lambda seen: seen[0])

    def __call__(self, parameters: Sequence[Mapping[str, float]]) -> list[Outcome]:
        return [self._outcome(np.log(list(each.values()))) for each in parameters]

    def _outcome(self, x: Floats) -> Outcome:
        self.simulations += 1
        parameters = self.extension.parameters(x)
        beat = self.run(self.extension, parameters)
        if not beat.completed:
            return beat.reason
        curves = beat_curves(beat, self.extension.setting.sensors(parameters))
        predicted = stacked(sampled(curves, self.target.samples))
        misfit = self.target.misfit(predicted)
        self.seen.append((0.5 * misfit + 0.5 * float(x @ x), x, misfit))
        return {str(index): value for index, value in enumerate(predicted.tolist())}
