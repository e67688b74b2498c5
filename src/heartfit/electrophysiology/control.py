r"""The electrical control u(t) of the contraction.

.. math:: u(X, t) = +k_{ATP} \text{ for } T_d(X) \le t - t_0 < T_d(X) + APD, \quad -k_{RS} \text{ otherwise}

periodic with the heart period. A step of the time scheme uses the exact mean of |u| and |u|_+ over the step,
so that the sum over a mesh does not depend on how T_d falls between the time levels. A tail leaves out a share of
k_RS at some times after repolarisation.
Source: Marchesseau et al., MICCAI 2012, section 2.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.parameter import parameter, require_admissible


class Tail(Protocol):
    """Relaxation that slows down."""

    def missing(self, time: Floats) -> Floats:
        """Integral, s, of the missing share of k_RS over [0, ``time``] after repolarisation."""


@dataclass(frozen=True)
class Control:
    """Rates and timing of the electrical control, and what slows the relaxation down."""

    k_ATP: float = parameter(6.0, unit="1/s", symbol="k_{ATP}", meaning="rate of contraction", sd=0.25)
    k_RS: float = parameter(14.0, unit="1/s", symbol="k_{RS}", meaning="rate of relaxation", sd=0.25)
    duration: float = parameter(0.34, unit="s", symbol="APD", meaning="action potential duration", sd=0.08)
    onset: float = parameter(
        0.13,
        unit="s",
        symbol="t_0",
        meaning="earliest ventricular activation after the start of atrial systole",
    )

    trigger_delay: float = parameter(
        0.045, unit="s", symbol="t_R", meaning="ECG trigger (R wave) after the earliest activation"
    )
    tails: tuple[Tail, ...] = ()

    def __post_init__(self) -> None:
        require_admissible(self)

    def mean(
        self, start: Floats | float, dt: float, activation: Floats, period: float
    ) -> tuple[Floats, Floats]:
        """Means of |u| and of |u|_+ over ``[start, start + dt]`` at points activated at ``activation``.

        Both may be arrays that broadcast, as many starts (n, 1) beside many points (m,).

        The action potential must end within one period; raises ``ValueError`` otherwise.
        """
        if self.duration >= period:
            raise ValueError(
                f"action potential of {self.duration:g} s: expected less than the period, {period:g} s"
            )
        depolarised = self._depolarised(start, dt, activation, period)
        attach = self.k_ATP * depolarised
        rate = attach + self.k_RS * (1.0 - depolarised)
        for tail in self.tails:
            rate = rate - self.k_RS * self._missing(tail, start, dt, activation, period)
        return rate, attach

    def _depolarised(self, start: Floats | float, dt: float, activation: Floats, period: float) -> Floats:
        """Fraction of the step that each point spends depolarised."""
        elapsed = np.mod(start - self.onset - activation, period)
        upper, lower = self._primitive(elapsed + dt, period), self._primitive(elapsed, period)
        fraction: Floats = (upper - lower) / dt
        return fraction

    def _primitive(self, time: Floats, period: float) -> Floats:
        """Time spent depolarised in [0, time], counted from the activation."""
        cycles, rest = np.divmod(time, period)
        spent: Floats = cycles * self.duration + np.minimum(rest, self.duration)
        return spent

    def _missing(
        self, tail: Tail, start: Floats | float, dt: float, activation: Floats, period: float
    ) -> Floats:
        """Mean over the step of the share of k_RS that the tail takes away from each point."""
        elapsed = np.mod(start - self.onset - activation, period)
        upper, lower = (self._taken(tail, time, period) for time in (elapsed + dt, elapsed))
        mean: Floats = (upper - lower) / dt
        return mean

    def _taken(self, tail: Tail, time: Floats, period: float) -> Floats:
        """Time of relaxation that the tail takes away in [0, time], counted from the activation."""
        cycles, rest = np.divmod(time, period)
        whole, begun = (tail.missing(np.maximum(each - self.duration, 0.0)) for each in (period, rest))
        return cycles * whole + begun
