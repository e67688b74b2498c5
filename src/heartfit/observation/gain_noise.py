r"""Noise of curves that registration shrinks and mixes: gains and an error with memory, estimated from known truth.

A registered curve of element s (a segment of the wall) at phase i, where the true curves are e, is modelled as

.. math:: y_{si} = (G + g)\, e_{si} + h_s\, p_{si} + m_{si} - m_{s0}

with the mean gain G, a gain :math:`g \sim N(0, \sigma_g^2)` of the sequence, gains :math:`h_s \sim N(0, \sigma_h^2)` of
the elements, and an error m of covariance :math:`s^2 e^{-|t_i - t_j| / \tau}`, of which all elements have the share r
in common. The gain of an element acts on a pattern p: its own curve :math:`e_s`, or the mean of all curves. The mean
stands for a smooth displacement, which mixes the motion of an element with that of its neighbours: an element that does
not move by itself, such as a scar, then keeps an error. Phase 0 is the reference of the curves and without error; late
phases have twice the variance of m. With :math:`\rho_{ij} = e^{-|t_i - t_j| / \tau}` and
:math:`K_{ij} = \rho_{ij} - \rho_{i0} - \rho_{0j} + 1` the covariance of all curves of a sequence is

.. math:: \Sigma_{ss'} = \sigma_g^2\, e_s e_{s'}^T + \delta_{ss'} \sigma_h^2\, p_s p_s^T
          + s^2 (r + (1 - r) \delta_{ss'}) K .

Estimates equate sums over the N sequences j with their expectations. P projects across :math:`e_{js}` and
:math:`p_{js}`, so that the projected residual :math:`d = y - G e` is free of gains; :math:`\Delta` are the steps from
phase to phase:

.. math::
    G = \frac{\sum_{js} y_{js} \cdot e_{js}}{\sum_{js} e_{js} \cdot e_{js}}, \quad
    \frac{\sum_{js} |\Delta P d_{js}|^2}{\sum_{js} |P d_{js}|^2} =
    \frac{\sum_{js} \mathrm{tr}\, \Delta P K P \Delta^T}{\sum_{js} \mathrm{tr}\, P K P}, \quad
    s^2 = \frac{\sum_{js} |P d_{js}|^2}{\sum_{js} \mathrm{tr}\, P K P} ,

of which the second holds at one memory only, and the share follows from the sum over the elements,

.. math::
    \sum_j \Bigl|\sum_s P d_{js}\Bigr|^2 = s^2 \sum_j \Bigl((1 - r) \sum_s \mathrm{tr}\, P_{js} K P_{js}
    + r\, \mathrm{tr}\, \bar P_j K \bar P_j\Bigr), \quad \bar P_j = \sum_s P_{js} .

The residual along the patterns has the gains. With :math:`C_j` the covariance of the error of all curves,

.. math::
    A &= \frac{N}{N - 1} \sum_j \Bigl(\sum_s d_{js} \cdot p_{js}\Bigr)^2 - \sum_{jss'} p_{js}^T C_{jss'} p_{js'}, \quad
    B = \sum_{js} (d_{js} \cdot p_{js})^2 - \sum_{js} p_{js}^T C_{jss} p_{js}, \\
    \sigma_g^2 &= \frac{A - B}{\sum_j ((\sum_s c_{js})^2 - \sum_s c_{js}^2)}, \quad
    \sigma_h^2 = \frac{B - \sigma_g^2 \sum_{js} c_{js}^2}{\sum_{js} (p_{js} \cdot p_{js})^2}, \quad
    c_{js} = e_{js} \cdot p_{js} ,

where a variance below zero is zero, as is a share, and N / (N - 1) accounts for the mean gain. A single curve has no
gain of its own: :math:`\sigma_g^2 = A / \sum_j c_j^2` and :math:`r = \sigma_h = 0`.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from scipy.linalg import block_diag
from scipy.optimize import brentq

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError

MEMORY_BOUNDS = (1e-3, 10.0)
"""Bounds of an estimated memory [s]: much less than a frame, and many beats."""
LARGEST_SHARE = 0.99
"""Largest estimated share that all elements have in common; at one the covariance would be singular."""
Pattern = Literal["own", "mean"]
"""Curve on which the gain of an element acts: its own, or the mean of all."""


@dataclass(frozen=True, eq=False)
class TrackedCurves:
    """Curves (k, p) of one sequence, true and registered, in one unit, at times (p,) [s]; zero in phase 0.

    Raises InputError for arrays of other shapes, and for true curves without any motion.
    """

    true: Floats
    registered: Floats
    times: Floats

    def __post_init__(self) -> None:
        expected = (len(self.true), self.times.size)
        if not self.true.shape == self.registered.shape == expected:
            raise InputError(
                f"gain noise: {self.true.shape} true and {self.registered.shape} registered samples at "
                f"{self.times.size} times; expected one for each curve and time"
            )
        if not self.true.any():
            raise InputError("gain noise: the true curves are zero; expected a heart that moves")


@dataclass(frozen=True)
class GainNoise:
    """Noise of the curves of one kind.

    gain: G [1]; common_sd: sigma_g [1]; element_sd: sigma_h [1]; sd: s in the unit of the curves; memory: tau [s];
    shared: r [1]; sequences: number from which it was estimated; pattern: p.
    """

    gain: float
    common_sd: float
    element_sd: float
    sd: float
    memory: float
    shared: float
    sequences: int
    pattern: Pattern = "mean"

    @classmethod
    def from_sequences(cls, sequences: Sequence[TrackedCurves], pattern: Pattern = "mean") -> "GainNoise":
        """Estimate the noise from sequences of known truth by the equations of the module.

        Raises InputError for fewer than two sequences.
        """
        if len(sequences) < 2:
            raise InputError(f"gain noise: {len(sequences)} sequences; expected at least two")
        gain = _mean_gain(sequences)
        patterns = [patterns_of(one.true, pattern) for one in sequences]
        sd, memory, shared = _error(sequences, patterns, gain)
        error = cls(gain, 0.0, 0.0, sd, memory, shared, len(sequences), pattern)
        common, element = _gain_deviations(sequences, patterns, error)
        return replace(error, common_sd=common, element_sd=element)

    def covariance(self, true: Floats, times: Floats) -> Floats:
        """Sigma (k p, k p) of the registered curves, curve after curve, where the true ones are ``true`` (k, p).

        times (p,): [s]. The unit is that of the curves, squared. Rows of phase 0 are zero: leave this phase out of a
        likelihood. The pattern "mean" takes the mean over all k curves.
        """
        patterns = self.element_sd * patterns_of(true, self.pattern)
        own = block_diag(*(np.outer(one, one) for one in patterns))
        common = self.common_sd**2 * np.outer(true, true)
        covariance: Floats = own + common + self.error_covariance(len(true), times)
        return covariance

    def error_covariance(self, curves: int, times: Floats) -> Floats:
        """C (k p, k p): covariance of m_i - m_0 of so many curves at times (p,) [s]."""
        between = self.shared + (1.0 - self.shared) * np.eye(curves)
        return np.asarray(np.kron(between, self.sd**2 * unit_covariance(times, self.memory)), np.float64)


def unit_covariance(times: Floats, memory: float) -> Floats:
    """K (p, p): covariance of m_i - m_0 for an m of variance 1 and this memory [s], at times (p,) [s]."""
    correlation = np.exp(-np.abs(times[:, None] - times) / memory)
    covariance: Floats = correlation - correlation[:, :1] - correlation[:1] + 1.0
    return covariance


def patterns_of(true: Floats, pattern: Pattern) -> Floats:
    """Curves p (k, p) on which the gains of the elements act."""
    return true if pattern == "own" else np.broadcast_to(true.mean(axis=0), true.shape)


def _mean_gain(sequences: Sequence[TrackedCurves]) -> float:
    """G."""
    along = sum(float((one.registered * one.true).sum()) for one in sequences)
    return along / sum(float((one.true**2).sum()) for one in sequences)


def _residual(sequence: TrackedCurves, gain: float) -> Floats:
    """d (k, p)."""
    residual: Floats = sequence.registered - gain * sequence.true
    return residual


def _error(
    sequences: Sequence[TrackedCurves], patterns: Sequence[Floats], gain: float
) -> tuple[float, float, float]:
    """s in the unit of the curves, tau [s] within MEMORY_BOUNDS, and r."""
    projections = [_projections(one.true, pattern) for one, pattern in zip(sequences, patterns, strict=True)]
    across = [
        np.einsum("kpq,kq->kp", projection, _residual(one, gain))
        for one, projection in zip(sequences, projections, strict=True)
    ]
    size = sum(float((part**2).sum()) for part in across)
    steps = sum(float((np.diff(part, axis=1) ** 2).sum()) for part in across)

    def expected(memory: float) -> Floats:
        units = (unit_covariance(one.times, memory) for one in sequences)
        return np.sum([_across(P, unit) for P, unit in zip(projections, units, strict=True)], axis=0)

    def excess(log_memory: float) -> float:
        expected_size, expected_steps, _ = expected(np.exp(log_memory))
        return float(expected_steps / expected_size * size - steps)

    low, high = np.log(MEMORY_BOUNDS)
    # a longer memory has smaller steps
    outside = low if excess(low) <= 0.0 else high if excess(high) >= 0.0 else None
    memory = float(np.exp(brentq(excess, low, high, xtol=1e-4) if outside is None else outside))
    own, _, together = expected(memory)
    variance, whole = size / own, sum(float((part.sum(axis=0) ** 2).sum()) for part in across)
    several = any(len(one.true) > 1 for one in sequences)
    shared = (whole / variance - own) / (together - own) if several else 0.0
    return float(np.sqrt(variance)), memory, float(np.clip(shared, 0.0, LARGEST_SHARE))


def _projections(true: Floats, pattern: Floats) -> Floats:
    """P (k, p, p) of each curve; that of a curve without motion is the identity."""
    columns = np.stack([true, pattern], axis=-1)
    projections: Floats = np.eye(true.shape[1]) - columns @ np.linalg.pinv(columns, rcond=1e-9)
    return projections


def _across(projections: Floats, unit: Floats) -> Floats:
    """Sums over the curves of tr P K P and of the same for the steps, and that of the sum of all curves (3,)."""
    across, whole = projections @ unit @ projections, projections.sum(axis=0)
    diagonal, beside = np.einsum("kii->ki", across), np.einsum("kii->ki", across[:, 1:, :-1])
    steps = (diagonal[:, 1:] + diagonal[:, :-1] - 2.0 * beside).sum()
    return np.array([diagonal.sum(), steps, np.trace(whole @ unit @ whole)])


def _gain_deviations(
    sequences: Sequence[TrackedCurves], patterns: Sequence[Floats], error: GainNoise
) -> tuple[float, float]:
    """sigma_g and sigma_h [1]; error: the noise without them."""
    A, B, between, squares, weights = 0.0, 0.0, 0.0, 0.0, 0.0
    count = len(sequences)
    for one, pattern in zip(sequences, patterns, strict=True):
        along = (_residual(one, error.gain) * pattern).sum(axis=1)
        shared = (one.true * pattern).sum(axis=1)
        noise = error.sd**2 * pattern @ unit_covariance(one.times, error.memory) @ pattern.T
        own = float(np.trace(noise))
        A += count / (count - 1) * float(along.sum()) ** 2
        A -= error.shared * float(noise.sum()) + (1.0 - error.shared) * own
        B += float((along**2).sum()) - own
        squares += float((shared**2).sum())
        between += float(shared.sum()) ** 2 - float((shared**2).sum())
        weights += float(((pattern**2).sum(axis=1) ** 2).sum())
    if all(len(one.true) == 1 for one in sequences):
        return float(np.sqrt(max(0.0, A / squares))), 0.0
    common = max(0.0, (A - B) / between)
    element = max(0.0, (B - common * squares) / weights)
    return float(np.sqrt(common)), float(np.sqrt(element))
