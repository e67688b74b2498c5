r"""Steps down the negative logarithm of a posterior, one simulation each.

.. math:: (H + \lambda I)\, s = g, \quad H = I + A^T R^{-1} A, \quad g = A^T R^{-1} r - x

by Levenberg and Marquardt, with slopes A that Broyden corrects by what each simulation shows. None is taken anew: a
three-dimensional beat is too dear, and its limit cycle too rough for short differences.

References: Marquardt 1963, doi:10.1137/0111030; Broyden 1965, doi:10.1090/S0025-5718-1965-0198670-6.
"""

from collections.abc import Callable

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.proof.split import Target

SETTLED = 0.3
"""Of the objective, in the unit of ln Z: a step that promises less moves no verdict."""
ROUGH = 1.0
"""The same of the undamped step, which the roughness of the simulation may refuse."""
STRIDE = 1.5
"""Longest step along a coordinate, in standard deviations of its prior: slopes hold no further."""
DAMPING = 0.1
"""The least; ten times more after a step that fails, a tenth after one down."""


class Walk:
    """The state of one minimisation: x (d,), predicted (n,), slopes (n, d); lower (d,): bounds of x."""

    def __init__(
        self,
        forward: Callable[[Floats], Floats | None],
        target: Target,
        lower: Floats,
        x: Floats,
        predicted: Floats,
        slopes: Floats,
    ) -> None:
        self.forward, self.target, self.lower = forward, target, lower
        self.x, self.predicted, self.slopes = x, predicted, slopes
        self.objective = self._objective(x, predicted)
        self.damping, self.ended, self.converged = DAMPING, False, False

    def advance(self) -> None:
        """One step, or the end."""
        slope, curvature = self._normal()
        full, step = (self._step(slope, curvature, damping) for damping in (0.0, self.damping))
        if _promise(step, slope, curvature) < SETTLED:
            self.ended, self.converged = True, _promise(full, slope, curvature) < ROUGH
        else:
            self._try(step)

    def covariance(self) -> Floats:
        """Of the coordinates (d, d), by the slopes as they are known."""
        return np.asarray(np.linalg.inv(self._normal()[1]), np.float64)

    def _normal(self) -> tuple[Floats, Floats]:
        """g (d,) and H (d, d)."""
        weighed = np.linalg.solve(self.target.covariance, self.slopes)
        slope = weighed.T @ (self.target.values() - self.predicted) - self.x
        return slope, np.eye(self.x.size) + self.slopes.T @ weighed

    def _step(self, slope: Floats, curvature: Floats, damping: float) -> Floats:
        """The best step within the bounds: what would cross one ends on it, and the others are found anew."""
        damped = curvature + damping * np.eye(self.x.size)
        held = (self.x <= self.lower) & (slope <= 0.0)
        step = np.zeros_like(self.x)
        for _ in range(self.x.size):
            left = slope - damped[:, held] @ step[held]
            step[~held] = np.linalg.solve(damped[np.ix_(~held, ~held)], left[~held])
            crossing = self.x + step < self.lower
            if not crossing.any():
                break
            step[crossing] = (self.lower - self.x)[crossing]
            held |= crossing
        return step * min(1.0, STRIDE / max(np.abs(step).max(), 1e-12))

    def _try(self, step: Floats) -> None:
        predicted = self.forward(self.x + step)
        objective = np.inf if predicted is None else self._objective(self.x + step, predicted)
        if predicted is not None:
            missed = predicted - self.predicted - self.slopes @ step
            self.slopes = self.slopes + np.outer(missed, step) / (step @ step)
        if predicted is not None and objective < self.objective:
            self.x, self.predicted, self.objective = self.x + step, predicted, objective
            self.damping = max(0.1 * self.damping, DAMPING)
        else:
            self.damping *= 10.0

    def _objective(self, x: Floats, predicted: Floats) -> float:
        return 0.5 * self.target.misfit(predicted) + 0.5 * float(x @ x)


def _promise(step: Floats, slope: Floats, curvature: Floats) -> float:
    """How far the quadratic model goes down along the step."""
    return float(step @ slope - 0.5 * step @ curvature @ step)
