r"""Steps down the negative logarithm of a posterior, by Levenberg and Marquardt.

.. math:: (H + \lambda I)\, s = g, \quad H = I + J^T \bar\Lambda J, \quad g = J^T \bar\Lambda r - x

with the mean precision of :mod:`heartfit.discovery.whitening`; coordinates on their bound and pushed against it stay.
Broyden keeps the Jacobian true along the steps taken. It is taken anew by finite differences after every two of them,
when a step fails, and before the end is believed. A simulation that fails shortens the step. A descent may be told what
it has to reach, and ends where fresh slopes do not promise it.

References: Marquardt 1963, doi:10.1137/0111030; Broyden 1965, doi:10.1090/S0025-5718-1965-0198670-6.
"""

import numpy as np

from heartfit.discovery.forward import Counted
from heartfit.discovery.whitening import Whitening
from heartfit.geometry.arrays import Floats

SHORT = 0.02
"""Prior standard deviations: a step that changes nothing one would report."""
SLIGHT = 0.05
"""Of the objective, in the unit of ln Z: a fortieth of the least difference that a verdict rests on."""
ROUGH = 1.0
"""Of the objective: what a full step may promise in vain, the simulation not being smooth on its scale."""
DAMPING = 1.0
"""The least, over the curvature of the prior, 1; ten times more after a step that fails, a tenth after one down. With a
tenth of it fits leave a curved valley by steps that are too long and stop beside its floor. None near the end."""
FRESH = 2
"""Steps after which the Jacobian is taken anew."""


class Descent:
    """The state of one minimisation: x (d,), predicted (n,), jacobian (n, d), of which ``trusted`` columns are kept."""

    def __init__(
        self,
        model: Counted,
        values: Floats,
        whitening: Whitening,
        x: Floats,
        predicted: Floats,
        jacobian: Floats,
        trusted: int,
        target: float,
    ) -> None:
        self.model, self.values, self.whitening = model, values, whitening
        self.x, self.predicted, self.jacobian, self.trusted = x, predicted, jacobian, trusted
        self.target = target
        self.objective = self._objective(x, predicted)
        self.damping, self.steps, self.lower = DAMPING, 0, model.hypothesis.lower
        self.fresh = self.ended = self.converged = False

    def advance(self) -> None:
        """One step, one Jacobian, or the end."""
        slope, gram = self.whitening.normal(self.values - self.predicted, self.jacobian)
        slope, curvature = slope - self.x, np.eye(self.x.size) + gram
        full, damped = (self._step(slope, curvature, damping) for damping in (0.0, self.damping))
        left = _promise(full, slope, curvature)
        step = full if left < ROUGH and self.damping == DAMPING else damped
        short = np.abs(full).max() < SHORT
        if self.fresh and self.objective - left > self.target:
            self.ended = True
        elif short or _promise(step, slope, curvature) < SLIGHT:
            self._settle(bool(short or left < ROUGH))
        else:
            self._try(self.x + step)

    def _step(self, slope: Floats, curvature: Floats, damping: float) -> Floats:
        free = (self.x > self.lower) | (slope > 0.0)
        step = np.zeros_like(self.x)
        held = curvature[np.ix_(free, free)] + damping * np.eye(int(free.sum()))
        step[free] = np.linalg.solve(held, slope[free])
        return np.maximum(self.x + step, self.lower) - self.x

    def _settle(self, converged: bool) -> None:
        """The end, if the Jacobian is fresh; else see whether a fresh one agrees."""
        if self.fresh:
            self.ended, self.converged = True, converged
        else:
            self._refresh()

    def _try(self, trial: Floats) -> None:
        predicted = self.model(trial)
        objective = np.inf if predicted is None else self._objective(trial, predicted)
        if predicted is not None and objective < self.objective:
            self._move(trial, predicted, objective)
        elif self.fresh:
            self.damping *= 10.0
        else:
            self._refresh()

    def _move(self, trial: Floats, predicted: Floats, objective: float) -> None:
        step = trial - self.x
        missed = predicted - self.predicted - self.jacobian @ step
        self.jacobian = self.jacobian + np.outer(missed, step) / (step @ step)
        self.x, self.predicted, self.objective = trial, predicted, objective
        self.damping, self.steps, self.fresh = max(0.1 * self.damping, DAMPING), self.steps + 1, False
        if self.steps == FRESH:
            self._refresh()

    def _refresh(self) -> None:
        anew = self.model.jacobian(self.x, self.predicted, self.trusted)
        self.jacobian = np.column_stack([self.jacobian[:, : self.trusted], anew])
        self.steps, self.fresh = 0, True

    def _objective(self, x: Floats, predicted: Floats) -> float:
        return 0.5 * float(x @ x) - self.whitening.log_likelihood(self.values - predicted)


def _promise(step: Floats, slope: Floats, curvature: Floats) -> float:
    """How far the quadratic model goes down along the step."""
    return float(step @ slope - 0.5 * step @ curvature @ step)
