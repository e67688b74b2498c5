r"""The most probable coordinates of a hypothesis.

Minimises :math:`-\ln p(y - f(x)) + \tfrac12 |x|^2` over x, one-sided coordinates not negative, by Levenberg and
Marquardt: :math:`(H + \lambda I)\, s = g` with H and g as in :mod:`heartfit.discovery.evidence`. The Jacobian is taken
by finite differences at the start, after every two accepted steps and before convergence is believed; between, Broyden
keeps it true along the steps taken. A simulation that fails shortens the step.

A fit counts as converged when, with a fresh Jacobian, the full step is below 0.05 prior standard deviations in every
coordinate or promises less than 0.02 of the objective. The evidence of a fit that is not is no evidence.

References: Marquardt 1963, doi:10.1137/0111030; Broyden 1965, doi:10.1090/S0025-5718-1965-0198670-6.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.discovery.forward import Counted
from heartfit.discovery.hypothesis import Hypothesis
from heartfit.discovery.whitening import Whitening
from heartfit.geometry.arrays import Floats

EASIEST = 0.1
ROUGH = 1.0
SHORT = 0.05
"""Prior standard deviations: a step that changes nothing one would report."""
SLIGHT = 0.2
"""Of the objective, in the unit of ln Z: a hundredth of what separates two verdicts."""
DAMPING = 0.1
"""At the start, over the curvature of the prior, 1; ten times more after a step that fails, a tenth after one."""
HARDEST = 1e6
"""Damping at which no step goes down any more."""
FRESH = 4
"""Accepted steps after which Broyden's Jacobian is replaced."""
LIMIT = 400
"""Simulations after which a fit is given up: three times what the slowest of the converged ones take."""


@dataclass(frozen=True, eq=False)
class Fit:
    """Where the search of one hypothesis ended: x (d,), predicted (n,), jacobian (n, d) by finite differences.

    objective: the minimised function.
    """

    hypothesis: Hypothesis
    x: Floats
    predicted: Floats
    jacobian: Floats
    objective: float
    converged: bool


def fit(
    model: Counted,
    values: Floats,
    whitening: Whitening,
    start: Floats,
    slopes: Floats | None = None,
    trusted: int = 0,
    limit: int = LIMIT,
) -> Fit | None:
    """The most probable coordinates seen from ``start`` (d,), or None where no simulation about it is completed.

    values: the data (n,); slopes: a Jacobian (n, d) to begin with, by finite differences if None, of
    which the first ``trusted`` columns are kept but for Broyden.
    """
    started = model.started(start)
    if started is None:
        return None
    jacobian = model.jacobian(*started) if slopes is None else slopes
    descent = _Descent(model, values, whitening, *started, jacobian, fresh=slopes is None, trusted=trusted)
    while not descent.ended and model.runs < limit:
        descent.advance()
    return descent.result()


class _Descent:
    """The state of one minimisation."""

    def __init__(
        self,
        model: Counted,
        values: Floats,
        whitening: Whitening,
        x: Floats,
        predicted: Floats,
        slopes: Floats,
        fresh: bool,
        trusted: int,
    ) -> None:
        self.model, self.values, self.whitening = model, values, whitening
        self.lower = model.hypothesis.lower
        self.x, self.predicted, self.objective = x, predicted, self._objective(x, predicted)
        self.jacobian, self.fresh, self.trusted = slopes, fresh, trusted
        self.damping, self.since, self.converged = DAMPING, 0, False

    @property
    def ended(self) -> bool:
        return self.converged or self.damping > HARDEST

    def advance(self) -> None:
        slope, curvature = self._normal()
        full = self._step(slope, curvature, 0.0)
        if np.abs(full).max() < SHORT or 0.5 * full @ slope < SLIGHT:
            self._believe()
        else:
            step = self._step(slope, curvature, self.damping)
            promise = step @ slope - 0.5 * step @ curvature @ step
            if self.fresh and promise < SLIGHT:
                self.converged = bool(0.5 * full @ slope < ROUGH)
                self.damping = 2 * HARDEST
            else:
                self._try(self.x + step)

    def result(self) -> Fit:
        hypothesis = self.model.hypothesis
        return Fit(hypothesis, self.x, self.predicted, self.jacobian, self.objective, self.converged)

    def _normal(self) -> tuple[Floats, Floats]:
        slope, gram = self.whitening.normal(self.values - self.predicted, self.jacobian)
        return slope - self.x, np.eye(self.x.size) + gram

    def _step(self, slope: Floats, curvature: Floats, damping: float) -> Floats:
        """The step (d,) of what no bound holds back."""
        free = (self.x > self.lower) | (slope > 0.0)
        step = np.zeros_like(self.x)
        held = curvature[np.ix_(free, free)] + damping * np.eye(int(free.sum()))
        step[free] = np.linalg.solve(held, slope[free])
        return np.maximum(self.x + step, self.lower) - self.x

    def _believe(self) -> None:
        """Convergence, if the Jacobian is fresh; else see whether a fresh one agrees."""
        if self.fresh:
            self.converged = True
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
        self.damping, self.since, self.fresh = max(0.1 * self.damping, EASIEST), self.since + 1, False
        if self.since == FRESH:
            self._refresh()

    def _refresh(self) -> None:
        anew = self.model.jacobian(self.x, self.predicted, self.trusted)
        self.jacobian = np.column_stack([self.jacobian[:, : self.trusted], anew])
        self.since, self.fresh = 0, True

    def _objective(self, x: Floats, predicted: Floats) -> float:
        return 0.5 * float(x @ x) - self.whitening.log_likelihood(self.values - predicted)
