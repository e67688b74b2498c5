r"""Noise of curves that registration shrinks: gains and an error with memory, estimated from known truth.

A registered curve of element s (a segment of the wall) at phase i of a sequence with the true curve e is modelled as

.. math:: y_{si} = (G + g + g_s)\, e_{si} + m_{si} - m_{s0}

with the mean gain G, a gain g ~ N(0, sd_g^2) of the sequence, gains g_s ~ N(0, sd_s^2) of the elements, and an error m
of covariance :math:`s^2 e^{-|t_i - t_j| / \tau}`, independent between elements. Phase 0 is the reference of the curves
and without error; late phases have twice the variance of m. With :math:`K_{ij} = \rho_{ij} - \rho_{i0} - \rho_{0j} + 1`
and :math:`\rho_{ij} = e^{-|t_i - t_j| / \tau}` the covariance of all curves of a sequence is

.. math:: \Sigma = sd_g^2\, e e^T + \mathrm{diag}_s(sd_s^2\, e_s e_s^T + s^2 K) .

Estimates equate sums over the N sequences j with their expectations. The part of the residual :math:`d = y - G e` across
the true curve is free of gains. With :math:`w_{js} = e_{js} \cdot e_{js}`, the projection
:math:`P = 1 - e_{js} e_{js}^T / w_{js}` and steps :math:`\Delta` from phase to phase,

.. math::
    G = \frac{\sum_{js} y_{js} \cdot e_{js}}{\sum_{js} w_{js}}, \quad
    \frac{\sum_{js} |\Delta P d_{js}|^2}{\sum_{js} |P d_{js}|^2} =
    \frac{\sum_{js} \mathrm{tr}\, \Delta P K P \Delta^T}{\sum_{js} \mathrm{tr}\, P K P}, \quad
    s^2 = \frac{\sum_{js} |P d_{js}|^2}{\sum_{js} \mathrm{tr}\, P K P} ,

of which the second holds at one memory only. The part along the true curve has the gains,

.. math::
    A = \frac{N}{N - 1} \sum_j \Bigl(\sum_s d_{js} \cdot e_{js}\Bigr)^2, \quad
    B = \sum_{js} (d_{js} \cdot e_{js})^2, \quad
    sd_g^2 = \frac{A - B}{\sum_j ((\sum_s w_{js})^2 - \sum_s w_{js}^2)}, \quad
    sd_g^2 + sd_s^2 = \frac{B - s^2 \sum_{js} e_{js}^T K e_{js}}{\sum_{js} w_{js}^2} ,

where a variance below zero is zero, and N / (N - 1) accounts for the mean gain. A single curve has no gain of its own:
the last fraction, with A in place of B, is then its :math:`sd_g^2`.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag
from scipy.optimize import brentq

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError

MEMORY_BOUNDS = (1e-3, 10.0)
"""Bounds of an estimated memory [s]: much less than a frame, and many beats."""


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

    gain: G [1]; common_sd: sd_g [1]; element_sd: sd_s [1]; sd: s in the unit of the curves; memory: tau [s];
    sequences: number from which it was estimated.
    """

    gain: float
    common_sd: float
    element_sd: float
    sd: float
    memory: float
    sequences: int

    @classmethod
    def from_sequences(cls, sequences: Sequence[TrackedCurves]) -> "GainNoise":
        """Estimate the noise from sequences of known truth, as the module says.

        A single curve has no gain of its own: its element_sd is zero. Raises InputError for fewer than two sequences.
        """
        if len(sequences) < 2:
            raise InputError(f"gain noise: {len(sequences)} sequences; expected at least two")
        gain = _mean_gain(sequences)
        sd, memory = _error_scale(sequences, gain)
        common, element = _gain_deviations(sequences, gain, sd, memory)
        return cls(gain, common, element, sd, memory, len(sequences))

    def covariance(self, true: Floats, times: Floats) -> Floats:
        """Sigma (k p, k p) of the registered curves, curve after curve, where the true ones are ``true`` (k, p).

        times (p,): [s]. Rows of phase 0 are zero: leave this phase out of a likelihood.
        """
        unit = unit_covariance(times, self.memory)
        blocks = [self.element_sd**2 * np.outer(one, one) + self.sd**2 * unit for one in true]
        covariance: Floats = block_diag(*blocks) + self.common_sd**2 * np.outer(true, true)
        return covariance

    def reduced_chi_square(self, sequence: TrackedCurves) -> float:
        """(y - G e)' Sigma^-1 (y - G e) over the number of samples after phase 0; its expectation is 1."""
        later = np.tile(np.arange(sequence.times.size) > 0, len(sequence.true))
        residual = _residual(sequence, self.gain).ravel()[later]
        covariance = self.covariance(sequence.true, sequence.times)[np.ix_(later, later)]
        return float(residual @ np.linalg.solve(covariance, residual)) / residual.size


def unit_covariance(times: Floats, memory: float) -> Floats:
    """K (p, p): covariance of m_i - m_0 for an m of variance 1 and this memory [s], at times (p,) [s]."""
    correlation = np.exp(-np.abs(times[:, None] - times) / memory)
    covariance: Floats = correlation - correlation[:, :1] - correlation[:1] + 1.0
    return covariance


def _mean_gain(sequences: Sequence[TrackedCurves]) -> float:
    """G."""
    along = sum(float((one.registered * one.true).sum()) for one in sequences)
    return along / sum(float((one.true**2).sum()) for one in sequences)


def _residual(sequence: TrackedCurves, gain: float) -> Floats:
    """d (k, p)."""
    residual: Floats = sequence.registered - gain * sequence.true
    return residual


def _error_scale(sequences: Sequence[TrackedCurves], gain: float) -> tuple[float, float]:
    """s in the unit of the curves and tau [s], within MEMORY_BOUNDS."""
    across = [_projections(one) @ _residual(one, gain)[..., None] for one in sequences]
    size = sum(float((part**2).sum()) for part in across)
    steps = sum(float((np.diff(part, axis=1) ** 2).sum()) for part in across)

    def excess(log_memory: float) -> float:
        expected_size, expected_steps = _expected_across(sequences, float(np.exp(log_memory)))
        return expected_steps / expected_size - steps / size

    low, high = np.log(MEMORY_BOUNDS)
    # a longer memory has smaller steps
    outside = low if excess(low) <= 0.0 else high if excess(high) >= 0.0 else None
    memory = float(np.exp(brentq(excess, low, high, xtol=1e-4) if outside is None else outside))
    return float(np.sqrt(size / _expected_across(sequences, memory)[0])), memory


def _projections(sequence: TrackedCurves) -> Floats:
    """P (k, p, p) of each curve; that of a curve without motion is the identity."""
    weights = (sequence.true**2).sum(axis=1)
    outer = sequence.true[:, :, None] * sequence.true[:, None, :]
    scaled = outer / np.where(weights > 0.0, weights, 1.0)[:, None, None]
    projections: Floats = np.eye(sequence.times.size) - scaled
    return projections


def _expected_across(sequences: Sequence[TrackedCurves], memory: float) -> tuple[float, float]:
    """Sums of tr P K P and of tr D P K P D' with D the steps, at a memory [s]."""
    size, steps = 0.0, 0.0
    for one in sequences:
        projections = _projections(one)
        across = projections @ unit_covariance(one.times, memory) @ projections
        diagonal = np.einsum("kii->ki", across)
        size += float(diagonal.sum())
        beside = np.einsum("kii->ki", across[:, 1:, :-1])
        steps += float((diagonal[:, 1:] + diagonal[:, :-1] - 2.0 * beside).sum())
    return size, steps


def _gain_deviations(
    sequences: Sequence[TrackedCurves], gain: float, sd: float, memory: float
) -> tuple[float, float]:
    """sd_g and sd_s [1]."""
    along = [(_residual(one, gain) * one.true).sum(axis=1) for one in sequences]
    weights = [(one.true**2).sum(axis=1) for one in sequences]
    count = len(sequences)
    A = count / (count - 1) * sum(float(part.sum()) ** 2 for part in along)
    B = sum(float((part**2).sum()) for part in along)
    squares = sum(float((weight**2).sum()) for weight in weights)
    noise = sd**2 * sum(
        float(np.einsum("sp,pq,sq->", one.true, unit_covariance(one.times, memory), one.true))
        for one in sequences
    )
    if all(len(weight) == 1 for weight in weights):
        return float(np.sqrt(max(0.0, (A - noise) / squares))), 0.0
    between = sum(float(weight.sum()) ** 2 for weight in weights) - squares
    common = max(0.0, (A - B) / between)
    element = max(0.0, (B - noise) / squares - common)
    return float(np.sqrt(common)), float(np.sqrt(element))
