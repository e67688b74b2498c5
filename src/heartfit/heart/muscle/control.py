r"""Inputs of the sarcomere law: the electrical control u(t) and the length dependence n_0.

The control switches between contraction and relaxation,

.. math:: u(X, t) = +k_{ATP} \text{ for } T_d(X) \le t - t_0 < T_d(X) + APD, \quad -k_{RS} \text{ otherwise}

periodic with the heart period. A step of the time scheme uses the exact means of |u| and |u|_+ over the step, so that
the sum over a mesh does not depend on the position of T_d between the time levels. A gain adds a share of k_ATP at some
times after activation, a tail removes a share of k_RS at some times after repolarisation. The length dependence is that
of :class:`Starling`. Source: Marchesseau et al., MICCAI 2012, section 2.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Protocol

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible


class AddedAttachment(Protocol):
    """Faster or slower contraction."""

    def added_integral(self, time: Floats) -> Floats:
        """Integral [s] of the added share of k_ATP over [0, ``time``] after activation."""


class Tail(Protocol):
    """Slower relaxation."""

    def missing_integral(self, time: Floats) -> Floats:
        """Integral [s] of the missing share of k_RS over [0, ``time``] after repolarisation."""


@dataclass(frozen=True)
class Control:
    """Rates and timing of the electrical control; ``gains`` change the contraction, ``tails`` slow the relaxation."""

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
        0.045,
        unit="s",
        symbol="t_R",
        meaning="ECG trigger (R wave) after the earliest activation, negative before it",
        low=-0.2,
    )
    gains: tuple[AddedAttachment, ...] = ()
    tails: tuple[Tail, ...] = ()

    def __post_init__(self) -> None:
        require_admissible(self)

    def mean(
        self, start: Floats | float, dt: float, activation: Floats, period: float
    ) -> tuple[Floats, Floats]:
        """Means of |u| and of |u|_+ [1/s] over ``[start, start + dt]`` at points activated at ``activation`` [s].

        ``start`` and ``activation`` broadcast, e.g. starts (n, 1) and points (m,). Raises ``ValueError`` unless the
        action potential ends within one period.
        """
        if self.duration >= period:
            raise ValueError(
                f"action potential of {self.duration:g} s: expected less than the period, {period:g} s"
            )
        depolarised = self._depolarised(start, dt, activation, period)
        attached = depolarised
        for gain in self.gains:
            added = partial(self._added_time, gain, period=period)
            attached = attached + self._mean(added, start, dt, activation, period)
        attach = self.k_ATP * (np.maximum(attached, 0.0) if self.gains else attached)
        rate = attach + self.k_RS * (1.0 - depolarised)
        for tail in self.tails:
            missing = partial(self._missing_time, tail, period=period)
            rate = rate - self.k_RS * self._mean(missing, start, dt, activation, period)
        return rate, attach

    def _depolarised(self, start: Floats | float, dt: float, activation: Floats, period: float) -> Floats:
        """Fraction of the step during which the points are depolarised."""
        return self._mean(partial(self._primitive, period=period), start, dt, activation, period)

    def _mean(
        self,
        integral: Callable[[Floats], Floats],
        start: Floats | float,
        dt: float,
        activation: Floats,
        period: float,
    ) -> Floats:
        """Mean over the step of a function with this ``integral`` over [0, time], counted from the activation."""
        elapsed = np.mod(start - self.onset - activation, period)
        mean: Floats = (integral(elapsed + dt) - integral(elapsed)) / dt
        return mean

    def _primitive(self, time: Floats, period: float) -> Floats:
        """Depolarised time [s] within [0, time], counted from the activation."""
        cycles, rest = np.divmod(time, period)
        spent: Floats = cycles * self.duration + np.minimum(rest, self.duration)
        return spent

    def _added_time(self, gain: AddedAttachment, time: Floats, period: float) -> Floats:
        """Integral [s] of the share that the gain adds within [0, time], counted from the activation."""
        cycles, rest = np.divmod(time, period)
        return cycles * gain.added_integral(np.asarray(period)) + gain.added_integral(rest)

    def _missing_time(self, tail: Tail, time: Floats, period: float) -> Floats:
        """Integral [s] of the share that the tail removes within [0, time], counted from the activation."""
        cycles, rest = np.divmod(time, period)
        whole, begun = (
            tail.missing_integral(np.maximum(duration - self.duration, 0.0)) for duration in (period, rest)
        )
        return cycles * whole + begun


class ControlMeans:
    """Means of one control at points activated at ``activation`` (m,) [s]; those of the last step are kept."""

    def __init__(self, control: Control, activation: Floats) -> None:
        self.control, self.activation = control, activation
        self._step: tuple[float, ...] = ()
        self._means = activation, activation

    def mean(self, start: float, dt: float, period: float) -> tuple[Floats, Floats]:
        """Means of |u| and of |u|_+ (m,) [1/s] as those of :meth:`Control.mean`; not to be changed."""
        if self._step != (start, dt, period):
            self._means = self.control.mean(start, dt, self.activation, period)
            self._step = start, dt, period
        return self._means

    def equals(self, other: "ControlMeans") -> bool:
        """True if the means are those of the ``other`` at all times."""
        return self.control == other.control and np.array_equal(self.activation, other.activation)


TABLE_EXTENSIONS = np.array([-0.1668, -0.0073, 0.0534, 0.0969, 0.1326, 0.2016, 0.4663, 0.9187, 1.1762])
TABLE_FRACTIONS = np.array([0.0, 0.5614, 0.7748, 0.8933, 0.9618, 1.0, 1.0, 0.1075, 0.0])
"""Piecewise linear table of PhysioBlocks: extensions of the sarcomere, and fractions n of available bridges."""


@dataclass(frozen=True)
class Starling:
    r"""Fraction of available bridges at the extension :math:`x = \sqrt{1 + 2 e_c} - 1`.

    .. math:: n_0 = \max\big(0,\; 1 - s\,(1 - n(x + x_0))\big)

    with the piecewise linear table :math:`n` of PhysioBlocks. The slope :math:`s = 0` gives
    :math:`n_0 = 1`, the setting of the public scene of the paper's group; the shift :math:`x_0` accounts for a
    reference configuration that is shorter than slack length. A slope above 1 leaves no bridge where
    :math:`n < 1 - 1/s`: a negative number of bridges would have a negative stiffness.
    """

    slope: float = parameter(0.0, unit="1", symbol="s", meaning="strength of the Starling effect", off=0.0)
    shift: float = parameter(
        0.2, unit="1", symbol="x_0", meaning="extension of the reference over slack length"
    )

    def constants(self) -> Floats:
        return np.array([self.slope, self.shift])

    def available_fraction(self, e_c: Floats) -> Floats:
        """Fraction n_0 at the contractile strains ``e_c`` (any shape)."""
        result: Floats = _available_fractions(np.ravel(e_c), self.constants()).reshape(np.shape(e_c))
        return result


@njit(cache=True, error_model="numpy")
def available_fraction(e_c, constants):  # type: ignore[no-untyped-def]
    """Fraction n_0 at one strain, with the ``constants`` (slope, shift)."""
    slope, shift = constants
    if slope == 0.0:
        return 1.0
    x = np.sqrt(max(1.0 + 2.0 * e_c, 0.0)) - 1.0 + shift
    i = np.searchsorted(TABLE_EXTENSIONS, x)
    if i == 0 or i == TABLE_EXTENSIONS.size:
        return max(1.0 - slope, 0.0)
    part = (x - TABLE_EXTENSIONS[i - 1]) / (TABLE_EXTENSIONS[i] - TABLE_EXTENSIONS[i - 1])
    return max(
        1.0 - slope * (1.0 - TABLE_FRACTIONS[i - 1] - part * (TABLE_FRACTIONS[i] - TABLE_FRACTIONS[i - 1])),
        0.0,
    )


@njit(cache=True, error_model="numpy")
def _available_fractions(e_c, constants):  # type: ignore[no-untyped-def]
    result = np.empty(e_c.size)
    for i in range(e_c.size):
        result[i] = available_fraction(e_c[i], constants)
    return result
