r"""An extension fitted to samples: one unscented step, then steps of one beat each.

The points of the unscented step lie one standard deviation of the prior to either side of its centre, the mechanism
switched on. Its slopes :math:`A = \mathrm{Cov}(Z, X) P^{-1}` begin a walk down

.. math:: \tfrac12 r^T R^{-1} r + \tfrac12 |x|^2 ,

see :mod:`heartfit.proof.walk`; where it ends lies the estimate, with the covariance
:math:`C = (I + A^T R^{-1} A)^{-1}` of the slopes there. An extension may also begin where the model without it ended,
with the slopes of there: that takes a fifth of the beats, and a weak effect is not lost on the way. By Laplace's
approximation

.. math:: \ln Z = -\tfrac12 r^T R^{-1} r - \tfrac12 |x|^2 + \tfrac12 \ln |C|
          + \sum_{a \ge 0} \ln 2 \Phi(x_a / \sigma_a) + \mathrm{const}

compares extensions that were fitted to the same samples; the sum is over amplitudes whose sign is known.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.beat import Beat
from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import CalibrationError, sigma_points, transform
from heartfit.geometry.arrays import Floats
from heartfit.observation.beat import beat_curves
from heartfit.proof.extension import Extension
from heartfit.proof.split import Target, sampled, stacked
from heartfit.proof.walk import Walk

Run = Callable[[Extension, Mapping[str, float]], Beat]
"""From an extended setting and all its parameters, by name and SI, to a beat."""


@dataclass(frozen=True, eq=False)
class Refit:
    """Names (d,), estimate x (d,) and covariance (d, d) of an extension's coordinates, and its parameters there, SI.

    misfit: r^T R^-1 r of n samples at the estimate; objective: what was minimised; log_evidence: up to a constant of
    the samples; simulations: beats it took; converged: whether no step promised to lower the objective; predicted (n,),
    slopes (n, d): of the samples at the estimate.
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
    predicted: Floats
    slopes: Floats

    @property
    def sd(self) -> Floats:
        """Standard deviations (d,) of the coordinates."""
        return np.sqrt(np.diag(self.covariance))


def refit(extension: Extension, run: Run, target: Target, most: int, amplitude: float = 1.0) -> Refit:
    """The refit after the unscented step and as many more as it takes, or ``most``.

    amplitude: of the mechanism at the centre of the unscented step, in its scales. Raises CalibrationError where the
    beat there or too many about it fail.
    """
    forward = _Forward(extension, run, target)
    start = extension.start(amplitude)
    return _walked(forward, start, *_unscented(extension.names, forward, start), most)


def continued(extension: Extension, run: Run, target: Target, most: int, none: Refit) -> Refit:
    """The refit from where the model without the last of the mechanisms ended, those half a scale on.

    Raises CalibrationError where the beat there fails.
    """
    forward = _Forward(extension, run, target)
    kept = none.estimate.size
    start = np.concatenate([none.estimate, extension.start(0.5)[kept:]])
    predicted = forward(start)
    if predicted is None:
        raise CalibrationError(f"refit: {', '.join(extension.effects)} half a scale on does not beat")
    added = [_column(forward, start, predicted, index) for index in range(kept, start.size)]
    return _walked(forward, start, predicted, np.column_stack([none.slopes, *added]), most)


def _column(forward: "_Forward", start: Floats, predicted: Floats, index: int) -> Floats:
    """The slope (n,) between the start and a point with an amplitude off, or another unknown one deviation on."""
    moved = start.copy()
    moved[index] = 0.0 if start[index] else 1.0
    seen = forward(moved)
    if seen is None:
        return np.zeros_like(predicted)
    return (predicted - seen) / (start[index] - moved[index])


def _walked(forward: "_Forward", start: Floats, predicted: Floats, slopes: Floats, most: int) -> Refit:
    extension, target = forward.extension, forward.target
    walk = Walk(forward, target, np.where(extension.one_sided, 0.0, -np.inf), start, predicted, slopes)
    for _ in range(most):
        if walk.ended:
            break
        walk.advance()
    covariance = walk.covariance()
    return Refit(
        extension.names,
        walk.x,
        covariance,
        extension.parameters(walk.x),
        target.misfit(walk.predicted),
        walk.objective,
        _log_evidence(walk.objective, walk.x, covariance, extension.one_sided),
        target.values().size,
        forward.simulations,
        walk.converged,
        walk.predicted,
        walk.slopes,
    )


def _unscented(names: tuple[str, ...], forward: "_Forward", start: Floats) -> tuple[Floats, Floats]:
    """What the start (d,) predicts (n,), and the slopes (n, d) about it."""
    around = Gaussian(names, start, np.eye(start.size) / start.size)
    points = sigma_points(around)
    seen = [forward(point.z) for point in points]
    centre = seen[0]
    if centre is None:
        raise CalibrationError(
            "refit: the beat at the centre of the prior fails; choose another prior or mesh"
        )
    values = np.array([centre if each is None else each for each in seen])
    completed = np.array([each is not None for each in seen])
    moments = transform(points, values, completed=completed)
    return centre, np.linalg.solve(around.covariance, moments.cov_xz).T


def _log_evidence(objective: float, x: Floats, covariance: Floats, one_sided: np.ndarray) -> float:
    from scipy.special import log_ndtr

    beyond = log_ndtr(x / np.sqrt(np.diag(covariance))) + np.log(2.0)
    return float(-objective + 0.5 * np.linalg.slogdet(covariance)[1] + beyond[one_sided].sum())


class _Forward:
    """What an extension predicts of the samples (n,) at coordinates (d,), None where its beat fails."""

    def __init__(self, extension: Extension, run: Run, target: Target) -> None:
        self.extension, self.run, self.target = extension, run, target
        self.simulations = 0

    def __call__(self, x: Floats) -> Floats | None:
        self.simulations += 1
        parameters = self.extension.parameters(x)
        beat = self.run(self.extension, parameters)
        if not beat.completed:
            return None
        curves = beat_curves(beat, self.extension.setting.sensors(parameters))
        return stacked(sampled(curves, self.target.samples))
