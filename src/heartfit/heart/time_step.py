r"""One step in time, of first or second order, and Anderson acceleration of its fixed-point iteration.

All parts of the heart take the same step. A quantity y whose rate :math:`\dot y` enters the equations at the end of a
step has there

.. math:: \dot y_{n+1} = (1 + b) \frac{y_{n+1} - y_n}{\Delta t} - b\, \frac{y_n - y_{n-1}}{\Delta t_{n-1}}
          = \frac{y_{n+1} - y^*}{w}, \qquad w = \frac{\Delta t}{1 + b},

that is a backward-Euler step of the effective length w from the shifted value :math:`y^*`. With b = 0 it is backward
Euler; :math:`b = \Delta t / (\Delta t + \Delta t_{n-1})` extrapolates the means of the last two steps and is
the second-order backward differentiation formula (BDF2), which damps what is stiff as backward Euler does.

The equations of a step are solved by a modified Newton iteration. Its stale tangent leaves a few slow modes;
Anderson acceleration removes them by mixing the last changes, at the cost of a small least-squares problem.

Sources: Hairer and Wanner, Solving Ordinary Differential Equations II, section V.1, for the scheme; Walker and Ni,
SIAM J. Numer. Anal. 49 (2011) 1715, for the acceleration.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.finite_elements.kinematics import StepFailed

Value = TypeVar("Value", float, Floats)


@dataclass(frozen=True)
class TimeStep:
    """Step from ``start`` to ``start + length`` [s] within beats of ``period`` [s].

    ``last`` is the length of the step before; without one, or with ``second_order`` off, b = 0.
    """

    start: float
    length: float
    period: float
    second_order: bool = True
    last: float | None = None

    @property
    def end(self) -> float:
        return self.start + self.length

    @cached_property
    def memory(self) -> float:
        """Weight b of the step before."""
        return self.length / (self.length + self.last) if self.last and self.second_order else 0.0

    @cached_property
    def effective(self) -> float:
        """Length w of the equivalent backward-Euler step [s]."""
        return self.length / (1.0 + self.memory)

    @cached_property
    def ahead(self) -> float:
        """Share of the change during the step before that is added to the value at the start, see starting_value."""
        return self.effective * self.memory / self.last if self.last and self.memory else 0.0

    def starting_value(self, now: Value, before: Value) -> Value:
        """Value y* at which the effective step starts, from those ``now`` and one step ``before``."""
        ahead = self.ahead
        return now + ahead * (now - before) if ahead else now

    def end_value(self, mean: Value, before: Value) -> Value:
        """Value at the end of the step, extrapolated from the means in this step and in the one ``before``."""
        return (1.0 + self.memory) * mean - self.memory * before

    def half(self, second: bool) -> "TimeStep":
        """First or second half of the step."""
        length = 0.5 * self.length
        start = self.start + length if second else self.start
        return TimeStep(start, length, self.period, self.second_order, length if second else self.last)


STATIC_STEP = TimeStep(0.0, np.inf, np.inf)
"""Infinite step, after which everything is at rest."""

ANDERSON_DEPTH = 5
"""Number of past changes that are mixed."""


class Anderson:
    """Anderson acceleration of one fixed-point iteration z -> z + change."""

    def __init__(self, weights: Floats) -> None:
        self._weights = weights
        self._changes: list[Floats] = []
        self._moves: list[Floats] = []
        self._last: tuple[Floats, Floats] | None = None

    def mix(self, z: Floats, change: Floats) -> Floats:
        """Mixed change (N,) at ``z`` (N,), where the plain iteration proposes ``change`` (N,).

        Raises StepFailed if the proposed change is not finite, or if the last changes cannot be mixed.
        """
        finite = np.isfinite(change)
        if not finite.all():
            raise StepFailed(
                f"the change of {np.count_nonzero(~finite)} of {finite.size} unknowns, unknown "
                f"{np.argmin(finite)} first, is not finite: the forces or the tangent there are not"
            )
        if self._last is not None:
            self._moves.append(z - self._last[0])
            self._changes.append(change - self._last[1])
            del self._moves[:-ANDERSON_DEPTH], self._changes[:-ANDERSON_DEPTH]
        self._last = (z.copy(), change.copy())
        if not self._changes:
            return change
        G, Z = np.array(self._changes).T, np.array(self._moves).T
        try:
            gamma = np.linalg.lstsq(G * self._weights[:, None], change * self._weights, rcond=1e-8)[0]
        except np.linalg.LinAlgError as failure:
            raise StepFailed(
                f"the least-squares mix of the last {len(self._changes)} changes failed: {failure}"
            ) from failure
        mixed: Floats = change - (Z + G) @ gamma
        return mixed

    def forget(self) -> None:
        """Discard the past changes: the iteration itself has changed."""
        self._changes, self._moves, self._last = [], [], None
