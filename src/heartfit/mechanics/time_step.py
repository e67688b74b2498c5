r"""One step in time, of first or second order, as every part of the heart takes it.

A quantity y whose rate :math:`\dot y` enters the equations at the end of a step has there

.. math:: \dot y_{n+1} = (1 + b) \frac{y_{n+1} - y_n}{\Delta t} - b\, \frac{y_n - y_{n-1}}{\Delta t_{n-1}}
          = \frac{y_{n+1} - y^*}{w}, \qquad w = \frac{\Delta t}{1 + b},

that is a backward-Euler step of the effective length w from the shifted value :math:`y^*`. With b = 0 it is backward
Euler itself; :math:`b = \Delta t / (\Delta t + \Delta t_{n-1})` extrapolates the means of the last two steps and is
the second-order backward differentiation formula (BDF2), which damps what is stiff as backward Euler does.
Source: Hairer and Wanner, Solving Ordinary Differential Equations II, section V.1.
"""

from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from heartfit.geometry.arrays import Floats

Value = TypeVar("Value", float, Floats)


@dataclass(frozen=True)
class TimeStep:
    """The step from ``start`` to ``start + length``, s, within beats of ``period``.

    ``last`` is the length of the step before it; without one, or with ``second_order`` off, b is 0.
    """

    start: float
    length: float
    period: float
    second_order: bool = True
    last: float | None = None

    @property
    def end(self) -> float:
        return self.start + self.length

    @property
    def memory(self) -> float:
        """The weight b of the step before."""
        return self.length / (self.length + self.last) if self.last and self.second_order else 0.0

    @property
    def effective(self) -> float:
        """The length w of the backward-Euler step that this step amounts to."""
        return self.length / (1.0 + self.memory)

    def shifted(self, now: Value, before: Value) -> Value:
        """The value y* from which the effective step starts, of those at its start and one step earlier."""
        if not self.memory:
            return now
        return now + self.effective * self.memory / self.last * (now - before)  # type: ignore[operator]

    def at_end(self, mean: Value, before: Value) -> Value:
        """What a quantity with the means ``mean`` in this step and ``before`` in the last is at the end."""
        return (1.0 + self.memory) * mean - self.memory * before

    def half(self, second: bool) -> "TimeStep":
        """One half of the step."""
        length = 0.5 * self.length
        start = self.start + length if second else self.start
        return TimeStep(start, length, self.period, self.second_order, length if second else self.last)


ENDLESS = TimeStep(0.0, np.inf, np.inf)
"""After which everything has come to rest."""
