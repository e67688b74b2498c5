r"""Steps down the negative logarithm of a posterior, by Levenberg and Marquardt with Broyden's updates.

.. math:: (H + \lambda I)\, s = g, \quad H = I + J^T \Lambda J, \quad g = J^T \Lambda r - x

with the precision :math:`\Lambda` that the likelihood gives at the residual r = y - f(x). Coordinates on their bound
and pushed against it stay. Broyden keeps the Jacobian true along the steps. A simulation that fails shortens the step.

A search has cheap simulations: it renews the Jacobian by finite differences after some steps, when a step fails, and
before it accepts convergence. A refit renews it after each step, by a tangent-linear beat. A search on a wall has
expensive simulations and never does. A :class:`Schedule` states which.

References: Marquardt 1963, doi:10.1137/0111030; Broyden 1965, doi:10.1090/S0025-5718-1965-0198670-6.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from heartfit.core.arrays import Floats

SIMULATION_ROUGHNESS = 1.0
"""Roughness of the objective [ln Z]: a full step that predicts a smaller decrease may find none."""


class Likelihood(Protocol):
    """The probability density of measured values, as a function of the residual (n,)."""

    def log_likelihood(self, residual: Floats) -> float:
        """ln p(r), up to a constant."""
        ...

    def normal(self, residual: Floats, jacobian: Floats) -> tuple[Floats, Floats]:
        """J' L r (d,) and J' L J (d, d) with the precision L at this residual."""
        ...


@dataclass(frozen=True, eq=False)
class InverseProblem:
    """Minimise -ln p(y - f(x)) + |x|^2 / 2 over x >= lower.

    forward: f, from coordinates (d,) to predictions (n,), None where the simulation fails; values: y (n,); lower (d,).
    """

    forward: Callable[[Floats], Floats | None]
    values: Floats
    likelihood: Likelihood
    lower: Floats

    def objective(self, x: Floats, predicted: Floats) -> float:
        """The minimised function at x (d,), where ``predicted`` (n,) is f(x)."""
        return 0.5 * float(x @ x) - self.likelihood.log_likelihood(self.values - predicted)

    def normal(self, x: Floats, predicted: Floats, jacobian: Floats) -> tuple[Floats, Floats]:
        """g (d,) and H (d, d): the negative gradient of the objective, and its curvature by Gauss and Newton."""
        slope, gram = self.likelihood.normal(self.values - predicted, jacobian)
        return slope - x, np.eye(x.size) + gram


@dataclass(frozen=True)
class Schedule:
    """Lengths of steps, corrections of the Jacobian, and stopping criteria.

    - objective_tolerance: a step with a smaller predicted decrease [ln Z] ends the descent.
    - least_decrease: so does a step after which the objective is lower by less [ln Z].
    - damping: the least lambda, over the curvature of the prior, 1; a failed step multiplies lambda by ten, a step down
      divides it by ten.
    - step_tolerance: an undamped step below it in every coordinate ends the descent [prior standard deviations].
    - longest_step: bound along any coordinate [prior standard deviations].
    - jacobian_refresh: steps after which the Jacobian is renewed; None for never.
    - full_near_end: take the undamped step where its predicted decrease is below the simulation's roughness.
    - correct_on_failure: let Broyden's update use a step that did not go down.
    - active_set: solve the step of the other coordinates again where one meets its bound; else project the step onto
      the bounds.
    """

    objective_tolerance: float
    damping: float
    step_tolerance: float = 0.0
    longest_step: float = np.inf
    jacobian_refresh: int | None = None
    full_near_end: bool = False
    correct_on_failure: bool = False
    active_set: bool = False
    least_decrease: float = 0.0


LONGEST_STEP = 1.5
"""Longest step along a coordinate [prior standard deviations], the range in which slopes are valid."""
EXPENSIVE = Schedule(0.3, 0.1, longest_step=LONGEST_STEP, correct_on_failure=True, active_set=True)
"""Schedule for expensive simulations: every one corrects the slopes, which the descent never renews, and a predicted
decrease below 0.3, which changes no verdict, ends it."""

Differences = Callable[[Floats, Floats, Floats], Floats]
"""A renewed Jacobian (n, d) at x (d,), from the predictions (n,) there and the current Jacobian (n, d)."""


class Descent:
    """The state of one minimisation: x (d,), predicted (n,), jacobian (n, d).

    differences: renews the Jacobian; None where the schedule never does. fresh: the Jacobian is as good as a renewed
    one. target: an objective; the descent ends where fresh slopes predict to stay above it.
    """

    def __init__(
        self,
        problem: InverseProblem,
        schedule: Schedule,
        x: Floats,
        predicted: Floats,
        jacobian: Floats,
        differences: Differences | None = None,
        fresh: bool = True,
        target: float = np.inf,
    ) -> None:
        self.problem, self.schedule, self.differences, self.target = problem, schedule, differences, target
        self.x, self.predicted, self.jacobian, self.fresh = x, predicted, jacobian, fresh
        self.objective = problem.objective(x, predicted)
        self.damping, self.steps = schedule.damping, 0
        self.ended = self.converged = False

    def advance(self) -> None:
        """Take one step, renew the Jacobian once, or end."""
        slope, curvature = self.problem.normal(self.x, self.predicted, self.jacobian)
        full, damped = (self._step(slope, curvature, damping) for damping in (0.0, self.damping))
        left = _predicted_decrease(full, slope, curvature)
        near = left < SIMULATION_ROUGHNESS and self.damping == self.schedule.damping
        step = full if near and self.schedule.full_near_end else damped
        short = np.abs(full).max() < self.schedule.step_tolerance
        if self.fresh and self.objective - left > self.target:
            self.ended = True
        elif short or _predicted_decrease(step, slope, curvature) < self.schedule.objective_tolerance:
            self._settle(bool(short or left < SIMULATION_ROUGHNESS))
        else:
            self._try(step)

    def run(self, most: int) -> None:
        """Advance until the descent ends, at most so many times."""
        for _ in range(most):
            if self.ended:
                break
            self.advance()

    def covariance(self) -> Floats:
        """H^-1 (d, d): the posterior covariance of the model that is linear about x."""
        return np.asarray(
            np.linalg.inv(self.problem.normal(self.x, self.predicted, self.jacobian)[1]), np.float64
        )

    def _step(self, slope: Floats, curvature: Floats, damping: float) -> Floats:
        """The damped step within the bounds, shortened to the longest."""
        damped = curvature + damping * np.eye(self.x.size)
        held = (self.x <= self.problem.lower) & (slope <= 0.0)
        step = np.zeros_like(self.x)
        for _ in range(self.x.size):
            rest = slope - damped[:, held] @ step[held]
            step[~held] = np.linalg.solve(damped[np.ix_(~held, ~held)], rest[~held])
            crossing = self.x + step < self.problem.lower
            if not (self.schedule.active_set and crossing.any()):
                break
            step[crossing] = (self.problem.lower - self.x)[crossing]
            held |= crossing
        if not self.schedule.active_set:
            step = np.maximum(self.x + step, self.problem.lower) - self.x
        return step * min(1.0, self.schedule.longest_step / max(np.abs(step).max(), 1e-12))

    def _settle(self, converged: bool) -> None:
        """End if the Jacobian is fresh; else renew it, so that the next step confirms the end."""
        if self.fresh:
            self.ended, self.converged = True, converged
        else:
            self._refresh()

    def _try(self, step: Floats) -> None:
        """Move to the end of the step if the objective is lower there."""
        predicted = self.problem.forward(self.x + step)
        if predicted is None:
            self._reject()
            return
        objective = self.problem.objective(self.x + step, predicted)
        down = objective < self.objective
        if down or self.schedule.correct_on_failure:
            missed = predicted - self.predicted - self.jacobian @ step
            self.jacobian = self.jacobian + np.outer(missed, step) / (step @ step)
        if down:
            self._accept(self.x + step, predicted, objective)
        else:
            self._reject()

    def _accept(self, x: Floats, predicted: Floats, objective: float) -> None:
        decrease = self.objective - objective
        self.x, self.predicted, self.objective = x, predicted, objective
        self.damping, self.steps = max(0.1 * self.damping, self.schedule.damping), self.steps + 1
        self.fresh = self.differences is None
        if self.steps == self.schedule.jacobian_refresh:
            self._refresh()
        if decrease < self.schedule.least_decrease:
            self.ended = self.converged = True

    def _reject(self) -> None:
        if self.fresh:
            self.damping *= 10.0
        else:
            self._refresh()

    def _refresh(self) -> None:
        if self.differences is not None:
            self.jacobian = self.differences(self.x, self.predicted, self.jacobian)
        self.steps, self.fresh = 0, True


def _predicted_decrease(step: Floats, slope: Floats, curvature: Floats) -> float:
    """Decrease of the quadratic model along the step."""
    return float(step @ slope - 0.5 * step @ curvature @ step)
