r"""Measured curves, their noise, and the whitened likelihood.

The noise of a block of samples at times :math:`t_i` is Gaussian with the covariance

.. math:: \Sigma_{ij} = s^2 e^{-|t_i - t_j| / \tau} + r^2 e^{-d_{ij} / \tau_r}, \quad
          d_{ij} = \min_k |t_i - t_j - k T| .

The first term is the instrument's, new in every beat, white where its memory tau is zero; its standard deviation s is
one of some levels, equally likely. The second is the small error of every model, the same in every beat: the distance
of phases d makes it periodic. The large error of a wrong model has the covariance

.. math:: K_{ij} = c^2 \exp\Bigl(-\frac{2 \sin^2(\pi (t_i - t_j) / T)}{(2 \pi l / T)^2}\Bigr) ,

smooth and periodic: see :mod:`heartfit.discovery.inference.context`.

Blocks are independent and every level l of a block's noise is equally likely, so that the likelihood of a residual r is

.. math:: p(r) = \prod_b \frac{1}{L_b} \sum_l N(r_b; 0, \Sigma_{bl}) .

Its logarithm has the slope of the mean precision :math:`\bar\Lambda_b = \sum_l w_l \Sigma_{bl}^{-1}`, where w are the
probabilities of the levels given r. With a discrepancy, :math:`\Sigma + g^2 K` takes the place of Sigma.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from scipy.linalg import block_diag

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError

STRUCTURE_SCALES = (0.0, 0.25, 0.5, 1.0, 2.0)
"""Scales of the structural covariance, equally likely; at 0 the model is the source of the data."""


@dataclass(frozen=True)
class Noise:
    """Noise of a curve in the unit of its values.

    levels: standard deviations s that are tried; memory: tau; roughness: r; roughness_memory: tau_r; discrepancy: c;
    length: l; all times are in the unit of the block's. The default times are those of a heart beat in seconds:
    :meth:`white` makes the noise of other data.
    """

    levels: tuple[float, ...]
    memory: float
    roughness: float
    discrepancy: float
    roughness_memory: float = 0.05
    length: float = 0.07

    @classmethod
    def white(cls, sd: float | Sequence[float], discrepancy: float, length: float) -> "Noise":
        """Return independent noise of one standard deviation, or of several that are equally likely.

        discrepancy, length: standard deviation and correlation length of what an unknown effect would do.
        """
        levels = tuple(float(level) for level in np.atleast_1d(sd))
        return cls(levels, 0.0, 0.0, discrepancy, length, length)

    @property
    def middle(self) -> float:
        """The expected level of a measurement that does not exist yet."""
        return self.levels[len(self.levels) // 2]

    def covariance(self, times: Floats, period: float, level: float) -> Floats:
        """Sigma (k, k) at one of the levels."""
        lags = np.abs(times[:, None] - times)
        phases = np.abs(lags - period * np.round(lags / period)) if np.isfinite(period) else lags
        instrument = np.exp(-lags / self.memory) if self.memory > 0.0 else np.eye(times.size)
        return level**2 * instrument + self.roughness**2 * np.exp(-phases / self.roughness_memory)

    def discrepancy_covariance(self, times: Floats, others: Floats, period: float) -> Floats:
        """K (k, m) between two sets of times."""
        lags = times[:, None] - others
        if not np.isfinite(period):
            return self.discrepancy**2 * np.exp(-0.5 * (lags / self.length) ** 2)
        turn = np.sin(np.pi * lags / period) * period / (np.pi * self.length)
        return self.discrepancy**2 * np.exp(-0.5 * turn**2)


@dataclass(frozen=True, eq=False)
class Block:
    """One measured curve: its name, its unit, and times (k,), which may span several periods.

    period: in the unit of the times, [s] of a heart; infinite where nothing repeats.
    """

    curve: str
    unit: str
    times: Floats
    period: float
    noise: Noise

    def __post_init__(self) -> None:
        object.__setattr__(self, "times", np.asarray(self.times, dtype=float))
        if not self.period > 0.0:
            raise InputError(
                f"block {self.curve}: period = {self.period:g}; expected a positive time, or math.inf where nothing "
                "repeats: correct it"
            )


@dataclass(frozen=True, eq=False)
class Data:
    """The measured values (n,), block after block.

    structure: covariance S (n, n) of what the structure of the model leaves, or of errors that several curves share;
    None where the model is trusted; scales: of S, equally likely. Blocks before the first one that has a part in S are
    independent of all others. Raises InputError unless values and times match in number and all values are finite.
    """

    values: Floats
    blocks: tuple[Block, ...]
    structure: Floats | None = None
    scales: tuple[float, ...] = STRUCTURE_SCALES

    def __post_init__(self) -> None:
        object.__setattr__(self, "values", np.asarray(self.values, dtype=float))
        expected = sum(block.times.size for block in self.blocks)
        if self.values.shape != (expected,):
            raise InputError(f"data: {self.values.shape} values; expected ({expected},), one for each time")
        if not np.isfinite(self.values).all():
            raise InputError("data: a value is not finite: leave the sample out")

    def noise_covariance(self, levels: Sequence[int]) -> Floats:
        """Sigma (n, n) with every block at one of its levels."""
        covariances = [
            block.noise.covariance(block.times, block.period, block.noise.levels[level])
            for block, level in zip(self.blocks, levels, strict=True)
        ]
        return np.asarray(block_diag(*covariances), np.float64)

    @property
    def independent(self) -> int:
        """Number of blocks before the first one that has a part in the structure."""
        if self.structure is None:
            return len(self.blocks)
        return next((i for i, rows in enumerate(self.rows) if self.structure[rows].any()), len(self.blocks))

    @property
    def rows(self) -> tuple[slice, ...]:
        """Slices of ``values``, one for each block."""
        ends = np.cumsum([block.times.size for block in self.blocks])
        return tuple(slice(end - block.times.size, end) for end, block in zip(ends, self.blocks, strict=True))


@dataclass(frozen=True, eq=False)
class Whitening:
    """Inverse Cholesky factors of each group of rows and level, (l, k, k), and the logarithms of their densities at 0.

    A group is a block or, with structure, all blocks that it ties, the last group; its levels are then all combinations
    of the blocks' levels and of the scales of the structure, whose numbers are ``combined``.
    """

    rows: tuple[slice, ...]
    roots: tuple[Floats, ...]
    peaks: tuple[Floats, ...]
    combined: tuple[int, ...] = ()
    scales: tuple[float, ...] = (0.0,)

    @classmethod
    def from_data(cls, data: Data, discrepancy: float = 0.0) -> "Whitening":
        """Whitening of the blocks' noise plus a discrepancy of size g."""
        blocks = [_covariances(block, discrepancy) for block in data.blocks]
        rows, groups = data.rows, blocks
        combined: tuple[int, ...] = ()
        if data.structure is not None:
            free = data.independent
            tied = slice(rows[free].start if free < len(rows) else data.values.size, data.values.size)
            rows = (*rows[:free], tied)
            groups = [*blocks[:free], _combine(blocks[free:], data.structure[tied, tied], data.scales)]
            combined = (*(len(block) for block in blocks[free:]), len(data.scales))
        roots = tuple(np.asarray(np.linalg.inv(np.linalg.cholesky(group)), np.float64) for group in groups)
        return cls(rows, roots, tuple(_peaks(root) for root in roots), combined, data.scales)

    def log_likelihood(self, residual: Floats) -> float:
        """ln p(r)."""
        return float(sum(_log_sum(level) - np.log(level.size) for level in self._levels(residual)))

    def most_probable_levels(self, residual: Floats) -> tuple[list[int], float]:
        """The most probable level of each block and scale of the structure."""
        best = [int(np.argmax(level)) for level in self._levels(residual)]
        if not self.combined:
            return best, 0.0
        *levels, scale = (int(place) for place in np.unravel_index(best[-1], self.combined))
        return [*best[:-1], *levels], self.scales[scale]

    def normal(self, residual: Floats, jacobian: Floats) -> tuple[Floats, Floats]:
        """J' L r (d,) and J' L J (d, d) with the mean precision L."""
        weights = [np.exp(level - _log_sum(level)) for level in self._levels(residual)]
        grams = self.grams(residual, jacobian)
        mean = [np.tensordot(weight, gram, 1) for weight, gram in zip(weights, grams, strict=True)]
        total = np.sum(mean, axis=0)
        return total[1:, 0], total[1:, 1:]

    def grams(self, residual: Floats, jacobian: Floats) -> list[Floats]:
        """(r, J)' Sigma^-1 (r, J) of each block, (l, d + 1, d + 1)."""
        table = np.column_stack([residual, jacobian])
        white = [root @ table[rows] for root, rows in zip(self.roots, self.rows, strict=True)]
        return [np.swapaxes(block, 1, 2) @ block for block in white]

    def _levels(self, residual: Floats) -> list[Floats]:
        """ln N(r_b; 0, Sigma_bl) of each block, (l,)."""
        white = [root @ residual[rows] for root, rows in zip(self.roots, self.rows, strict=True)]
        return [
            peak - 0.5 * np.einsum("lk,lk->l", block, block)
            for peak, block in zip(self.peaks, white, strict=True)
        ]


def _log_sum(values: Floats) -> float:
    """ln sum exp; scipy's checks of few values cost more than the sum, thousands of times in a search."""
    return float(np.logaddexp.reduce(values))


def _covariances(block: Block, discrepancy: float) -> Floats:
    """Sigma + g^2 K (l, k, k) of a block at each of its levels."""
    extra = discrepancy**2 * block.noise.discrepancy_covariance(block.times, block.times, block.period)
    levels = block.noise.levels
    return np.array([block.noise.covariance(block.times, block.period, level) + extra for level in levels])


def _combine(blocks: Sequence[Floats], structure: Floats, scales: Sequence[float]) -> Floats:
    """Covariances (c, n, n) of all combinations of the blocks' levels and the scales of the structure."""
    scaled = [scale**2 * structure for scale in scales]
    return np.array([block_diag(*levels) + extra for levels in product(*blocks) for extra in scaled])


def _peaks(roots: Floats) -> Floats:
    diagonals = np.diagonal(roots, axis1=1, axis2=2)
    peaks: Floats = np.log(diagonals).sum(axis=1) - 0.5 * roots.shape[1] * np.log(2.0 * np.pi)
    return peaks
