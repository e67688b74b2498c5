r"""Fit of an extension to samples: slopes by one tangent-linear beat, then steps of one beat each.

The slopes at the prior mean, the mechanism switched on, start the descent of

.. math:: \tfrac12 r^T R^{-1} r + \tfrac12 |x|^2 ,

see :mod:`heartfit.discovery.inference.descent`: a step costs one beat, and Broyden's update corrects the slopes after
each. Where the descent ends all slopes are renewed, and it goes on, at most RENEWALS times: along directions in which
no step was taken the first ones are those of the prior mean. The end is the estimate, with the
covariance :math:`C = (I + A^T R^{-1} A)^{-1}` of the slopes there. An extension starts where the model without it
started and where it ended, with the slopes there and one more beat for each further unknown. Laplace's approximation

.. math:: \ln Z = -\tfrac12 r^T R^{-1} r - \tfrac12 |x|^2 + \tfrac12 g^T C g + \tfrac12 \ln |C|
          + \ln 2^k P(a \ge 0) + \mathrm{const}

compares extensions that were fitted to the same samples. The gradient :math:`g = A^T R^{-1} r - x` does not vanish
where an amplitude is held at its bound; P is the share of the posterior N(x + C g, C) in which the k amplitudes of
known sign are not negative, see :mod:`heartfit.discovery.inference.evidence`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import CalibrationError
from heartfit.core.arrays import Floats
from heartfit.discovery.inference.descent import EXPENSIVE, Descent, InverseProblem
from heartfit.discovery.inference.evidence import laplace
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.nearby_beats import Simulator, points_around
from heartfit.discovery.refit.target import Target, sample, stack
from heartfit.heart.beat import Beat
from heartfit.observation.beat import beat_curves

RENEWALS = 2
"""Largest number of times that a refit renews its slopes where the descent has ended."""


@dataclass(frozen=True, eq=False)
class Refit:
    """Names (d,), estimate x (d,) and covariance (d, d) of an extension's coordinates, and its parameters there [SI].

    misfit: r^T R^-1 r of n samples at the estimate; objective: the minimised function; log_evidence: up to a
    constant of the samples; simulations: number of beats, a tangent-linear one counting once; converged: no step was
    predicted to lower the objective; predicted (n,), slopes (n, d): of the samples at the estimate; first_slopes
    (n, d): at the prior mean;
    complete_slopes (m, d): of both halves of the samples, where they were last renewed, NaN where a beat failed.
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
    first_slopes: Floats
    complete_slopes: Floats | None = None

    @property
    def posterior(self) -> Gaussian:
        """The coordinates, given the fitted samples."""
        return Gaussian(self.names, self.estimate, self.covariance)


def refit(extension: Extension, run: Simulator, target: Target, most: int, amplitude: float = 1.0) -> Refit:
    """Refit an extension from the prior mean by at most ``most`` steps of one beat, with the slopes there.

    A descent with slopes of the prior mean may end far from the minimum: :func:`renew_slopes` goes on from its end.
    amplitude: of the mechanism there [scales]. A coordinate whose neighbouring beat fails starts without a slope.
    Raises CalibrationError if the beat at the prior mean fails.
    """
    forward = _Forward(extension, run, target)
    start = extension.start(amplitude)
    predicted = forward(start)
    if predicted is None:
        raise CalibrationError("refit: the beat at the prior mean fails; choose another prior or mesh")
    slopes = np.nan_to_num(forward.slopes(start))
    return _descend(forward, start, predicted, slopes, slopes, most)


def continue_refit(extension: Extension, run: Simulator, target: Target, most: int, base: Refit) -> Refit:
    """Refit from the estimate of the model without the last mechanisms, with these at half a scale.

    Raises CalibrationError if the beat there fails.
    """
    return _extend(extension, run, target, most, base, base.estimate, base.slopes, 0.5)


def restart_refit(extension: Extension, run: Simulator, target: Target, most: int, base: Refit) -> Refit:
    """Refit from the prior means with the last mechanisms at one scale, and the first slopes of the model without them.

    Raises CalibrationError if the beat there fails.
    """
    start = extension.start()[: base.estimate.size]
    return _extend(extension, run, target, most, base, start, base.first_slopes, 1.0)


def _extend(
    extension: Extension,
    run: Simulator,
    target: Target,
    most: int,
    base: Refit,
    kept: Floats,
    slopes: Floats,
    amplitude: float,
) -> Refit:
    """Refit from the coordinates ``kept`` (k,) of the base, with their slopes (n, k)."""
    forward = _Forward(extension, run, target)
    start = np.concatenate([kept, extension.start(amplitude)[kept.size :]])
    predicted = forward(start)
    if predicted is None:
        raise CalibrationError(
            f"refit: {', '.join(extension.effects)} at {amplitude:g} of the scale does not beat"
        )
    added = [_column(forward, start, predicted, index) for index in range(kept.size, start.size)]
    with_added, first = (np.column_stack([known, *added]) for known in (slopes, base.first_slopes))
    return _descend(forward, start, predicted, with_added, first, most)


def converged_refit(
    extension: Extension, run: Simulator, target: Target, complete: Target, most: int
) -> Refit:
    """Refit from the prior mean, and renew the slopes where it ends; see :func:`refit` and :func:`renew_slopes`."""
    return renew_slopes(extension, run, target, complete, most, refit(extension, run, target, most))


def renew_slopes(
    extension: Extension, run: Simulator, target: Target, complete: Target, most: int, fit: Refit
) -> Refit:
    """Renew all slopes at the estimate of a refit and descend from there, again if that was worth it.

    complete: both halves of the samples; the same beats give their slopes, which the descent does not use. A slope is
    kept where its neighbouring beat fails. Raises CalibrationError if a beat at an estimate fails.
    """
    for _ in range(RENEWALS):
        renewed = _renewed_once(extension, run, target, complete, most, fit)
        settled = fit.objective - renewed.objective < EXPENSIVE.objective_tolerance
        fit = renewed
        if settled:
            break
    return fit


def _renewed_once(
    extension: Extension, run: Simulator, target: Target, complete: Target, most: int, fit: Refit
) -> Refit:
    forward = _Forward(extension, run, complete)
    slopes = forward.slopes(fit.estimate)
    fitted = slopes[complete.rows_of(target.samples)]
    known = np.where(np.isnan(fitted), fit.slopes, fitted)
    again = _Forward(extension, run, target)
    renewed = _descend(again, fit.estimate, fit.predicted, known, fit.first_slopes, most)
    beats = fit.simulations + forward.simulations + renewed.simulations
    return replace(renewed, simulations=beats, complete_slopes=slopes)


def complete_posterior(
    extension: Extension, fit: Refit, complete: Target, predicted: Floats
) -> Gaussian | None:
    """Return the posterior of the coordinates given both halves of the samples, or None without all their slopes.

    One linear step from the estimate of the refit, x + H^-1 g with the prior once and R of all samples; predicted (m,):
    of all samples at the estimate. It judges nothing, since the half that judged is now fitted, too.
    """
    slopes = fit.complete_slopes
    if slopes is None or np.isnan(slopes).any():
        return None
    slope, gram = complete.normal(complete.values() - predicted, slopes)
    covariance = np.linalg.inv(np.eye(fit.estimate.size) + gram)
    lower = np.where(extension.one_sided, 0.0, -np.inf)
    return Gaussian(
        fit.names,
        np.maximum(fit.estimate + covariance @ (slope - fit.estimate), lower),
        0.5 * (covariance + covariance.T),
    )


def _column(forward: "_Forward", start: Floats, predicted: Floats, index: int) -> Floats:
    """Slope (n,) from the start to a point with the amplitude at 0, or another unknown at one standard deviation."""
    shifted = start.copy()
    shifted[index] = 0.0 if start[index] else 1.0
    prediction = forward(shifted)
    if prediction is None:
        return np.zeros_like(predicted)
    return (predicted - prediction) / (start[index] - shifted[index])


def _descend(
    forward: "_Forward",
    start: Floats,
    predicted: Floats,
    slopes: Floats,
    first_slopes: Floats,
    most: int,
) -> Refit:
    extension, target = forward.extension, forward.target
    lower = np.where(extension.one_sided, 0.0, -np.inf)
    problem = InverseProblem(forward, target.values(), target, lower)
    descent = Descent(problem, EXPENSIVE, start, predicted, slopes)
    descent.run(most)
    covariance = descent.covariance()
    gradient = problem.normal(descent.x, descent.predicted, descent.jacobian)[0]
    step = covariance @ gradient
    volume, kept = laplace(descent.x + step, covariance, extension.one_sided)
    return Refit(
        extension.names,
        descent.x,
        covariance,
        extension.parameters(descent.x),
        target.misfit(descent.predicted),
        descent.objective,
        float(-descent.objective + 0.5 * gradient @ step + volume + kept),
        target.values().size,
        forward.simulations,
        descent.converged,
        descent.predicted,
        descent.jacobian,
        first_slopes,
    )


class _Forward:
    """Prediction of the samples (n,) by an extension at coordinates (d,); None if its beat fails."""

    def __init__(self, extension: Extension, run: Simulator, target: Target) -> None:
        self.extension, self.run, self.target = extension, run, target
        self.simulations = 0

    def __call__(self, x: Floats) -> Floats | None:
        self.simulations += 1
        return self._samples(self.run(self.extension, self.extension.parameters(x)), x)

    def slopes(self, x: Floats) -> Floats:
        """Slopes (n, d) at the coordinates (d,), NaN where a neighbouring beat fails.

        Raises CalibrationError if the beat at the coordinates fails.
        """
        around = self.run.nearby(self.extension, x)
        self.simulations += around.simulations
        beats = (around.centre, *around.others)
        centre, *others = map(self._samples, beats, points_around(x, around.step))
        if centre is None:
            raise CalibrationError("refit: the beat at the estimate fails when it is repeated")
        missing = np.full(centre.size, np.nan)
        return np.column_stack([missing if z is None else (z - centre) / around.step for z in others])

    def _samples(self, beat: Beat, x: Floats) -> Floats | None:
        if not beat.completed:
            return None
        curves = beat_curves(beat, self.extension.setting.sensors(self.extension.parameters(x)))
        return stack(sample(curves, self.target.samples))
