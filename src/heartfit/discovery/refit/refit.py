r"""Fit of an extension to samples: every step down has the slopes of one tangent-linear beat.

The descent of

.. math:: \tfrac12 r^T R^{-1} r + \tfrac12 |x|^2 ,

see :mod:`heartfit.discovery.inference.descent`, starts at the prior mean, the mechanism switched on; an extension
starts where the model without it ended. All slopes are renewed after each step: with the 29 unknowns of two ventricles
a descent that only corrects its slopes stops far above the minimum. The end is the estimate, with the covariance
:math:`C = (I + A^T R^{-1} A)^{-1}` of the slopes there. Laplace's approximation

.. math:: \ln Z = -\tfrac12 r^T R^{-1} r - \tfrac12 |x|^2 + \tfrac12 g^T C g + \tfrac12 \ln |C|
          + \ln 2^k P(a \ge 0) + \mathrm{const}

compares extensions that were fitted to the same samples. The gradient :math:`g = A^T R^{-1} r - x` does not vanish
where an amplitude is held at its bound; P is the share of the posterior N(x + C g, C) in which the k amplitudes of
known sign are not negative, see :mod:`heartfit.discovery.inference.evidence`.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import CalibrationError
from heartfit.core.arrays import Floats
from heartfit.discovery.inference.descent import LONGEST_STEP, Descent, InverseProblem, Schedule
from heartfit.discovery.inference.evidence import laplace
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.nearby_beats import Simulator, points_around
from heartfit.discovery.refit.target import Target, sample, stack
from heartfit.heart.beat import Beat
from heartfit.observation.beat import beat_curves

SCHEDULE = Schedule(
    0.3,
    0.1,
    longest_step=LONGEST_STEP,
    jacobian_refresh=1,
    full_near_end=True,
    active_set=True,
    least_decrease=0.3,
)
"""Steps with slopes of their own, until one is predicted to lower the objective, or lowers it, by less than 0.3, which
changes no verdict."""
SLOPE_BEATS = 60
"""Beats of one refit after which slopes are corrected instead of renewed: where a tangent-linear beat fails, each slope
costs one."""


@dataclass(frozen=True, eq=False)
class Refit:
    """Names (d,), estimate x (d,) and covariance (d, d) of an extension's coordinates, and its parameters there [SI].

    misfit: r^T R^-1 r of n samples at the estimate; objective: the minimised function; log_evidence: up to a
    constant of the samples; simulations: number of beats, a tangent-linear one counting once; converged: no step was
    predicted to lower the objective; predicted (n,), slopes (n, d): of the samples at the estimate; complete_slopes
    (m, d): of both halves of the samples, where slopes were last renewed, NaN where a neighbouring beat failed.
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
    complete_slopes: Floats

    @property
    def posterior(self) -> Gaussian:
        """The coordinates, given the fitted samples."""
        return Gaussian(self.names, self.estimate, self.covariance)


def refit(extension: Extension, run: Simulator, target: Target, complete: Target, most: int) -> Refit:
    """Refit an extension from the prior mean by at most ``most`` steps, with its mechanisms at one scale.

    complete: both halves of the samples; the same beats give their slopes, which the descent does not use. Raises
    CalibrationError if the beat at the prior mean fails.
    """
    return _descend(_Forward(extension, run, target, complete), extension.start(), most)


def continue_refit(
    extension: Extension, run: Simulator, target: Target, complete: Target, most: int, base: Refit
) -> Refit:
    """Refit from the estimate of the model without the last mechanisms, with these at half a scale.

    Raises CalibrationError if the beat there fails.
    """
    start = np.concatenate([base.estimate, extension.start(0.5)[base.estimate.size :]])
    return _descend(_Forward(extension, run, target, complete), start, most)


def complete_posterior(
    extension: Extension, fit: Refit, complete: Target, predicted: Floats
) -> Gaussian | None:
    """Return the posterior of the coordinates given both halves of the samples, or None without all their slopes.

    One linear step from the estimate of the refit, x + H^-1 g with the prior once and R of all samples; predicted (m,):
    of all samples at the estimate. It judges nothing, since the half that judged is now fitted, too.
    """
    slopes = fit.complete_slopes
    if np.isnan(slopes).any():
        return None
    slope, gram = complete.normal(complete.values() - predicted, slopes)
    covariance = np.linalg.inv(np.eye(fit.estimate.size) + gram)
    lower = np.where(extension.one_sided, 0.0, -np.inf)
    return Gaussian(
        fit.names,
        np.maximum(fit.estimate + covariance @ (slope - fit.estimate), lower),
        0.5 * (covariance + covariance.T),
    )


def _descend(forward: "_Forward", start: Floats, most: int) -> Refit:
    """Refit from the coordinates ``start`` (d,); a slope without a neighbouring beat is 0, or stays as it was."""
    extension, target = forward.extension, forward.target
    predicted = forward(start)
    if predicted is None:
        effects = f" with {', '.join(extension.effects)}" if extension.effects else ""
        raise CalibrationError(f"refit: the beat at the start{effects} fails; choose another prior or mesh")
    lower = np.where(extension.one_sided, 0.0, -np.inf)
    problem = InverseProblem(forward, target.values(), target, lower)
    unknown = np.zeros((predicted.size, start.size))
    slopes = forward.slopes(start, predicted, unknown)
    descent = Descent(problem, SCHEDULE, start, predicted, slopes, forward.slopes)
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
        forward.complete_slopes,
    )


class _Forward:
    """Prediction of the fitted samples (n,) by an extension at coordinates (d,); None if its beat fails.

    complete_slopes (m, d): of both halves of the samples, where slopes were last renewed.
    """

    def __init__(self, extension: Extension, run: Simulator, target: Target, complete: Target) -> None:
        self.extension, self.run, self.target, self.complete = extension, run, target, complete
        self.simulations = self.slope_beats = 0
        self.complete_slopes = np.empty((0, 0))

    def __call__(self, x: Floats) -> Floats | None:
        self.simulations += 1
        return self._samples(self.run(self.extension, self.extension.parameters(x)), x, self.target)

    def slopes(self, x: Floats, _predicted: Floats, known: Floats) -> Floats:
        """Slopes (n, d) at the coordinates (d,), the known ones (n, d) where there is no beat or too many were run.

        Raises CalibrationError if the beat at the coordinates fails.
        """
        if self.slope_beats >= SLOPE_BEATS:
            return known
        around = self.run.nearby(self.extension, x)
        self.simulations += around.simulations
        self.slope_beats += around.simulations
        beats, points = (around.centre, *around.others), points_around(x, around.step)
        centre, *others = (
            self._samples(beat, point, self.complete) for beat, point in zip(beats, points, strict=True)
        )
        if centre is None:
            raise CalibrationError("refit: the beat at the estimate fails when it is repeated")
        missing = np.full(centre.size, np.nan)
        columns = [missing if other is None else (other - centre) / around.step for other in others]
        self.complete_slopes = np.column_stack(columns)
        fitted = self.complete_slopes[self.complete.rows_of(self.target.samples)]
        slopes: Floats = np.where(np.isnan(fitted), known, fitted)
        return slopes

    def _samples(self, beat: Beat, x: Floats, target: Target) -> Floats | None:
        if not beat.completed:
            return None
        curves = beat_curves(beat, self.extension.setting.sensors(self.extension.parameters(x)))
        return stack(sample(curves, target.samples))
