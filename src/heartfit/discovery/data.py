r"""Measured curves and their noise.

The noise of a block of samples at times :math:`t_i` is Gaussian with the covariance

.. math:: \Sigma_{ij} = s^2 e^{-|t_i - t_j| / \tau} + r^2 e^{-d_{ij} / \tau_r}, \quad
          d_{ij} = \min_k |t_i - t_j - k T| .

The first term is the instrument's, new in every beat, white where its memory tau is zero; its standard deviation s is
one of some levels, equally likely. The second is what every model gets wrong by a little, the same in every beat: the
distance of phases d makes it periodic. What a model gets wrong by much, if it is wrong, is

.. math:: K_{ij} = c^2 \exp\Bigl(-\frac{2 \sin^2(\pi (t_i - t_j) / T)}{(2 \pi l / T)^2}\Bigr) ,

smooth and periodic: see :mod:`heartfit.discovery.rival`.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats


@dataclass(frozen=True)
class Noise:
    """Noise of a curve in the unit of its values.

    levels: standard deviations s that are tried; memory tau, s; roughness r and its memory, s; discrepancy c and its
    length l, s.
    """

    levels: tuple[float, ...]
    memory: float
    roughness: float
    discrepancy: float
    roughness_memory: float = 0.05
    length: float = 0.07

    @property
    def middle(self) -> float:
        """The level to expect of a measurement not yet made."""
        return self.levels[len(self.levels) // 2]

    def covariance(self, times: Floats, period: float, level: float) -> Floats:
        """Sigma (k, k) at one of the levels."""
        apart = np.abs(times[:, None] - times)
        phases = np.abs(apart - period * np.round(apart / period))
        instrument = np.exp(-apart / self.memory) if self.memory > 0.0 else np.eye(times.size)
        return level**2 * instrument + self.roughness**2 * np.exp(-phases / self.roughness_memory)

    def discrepancy_covariance(self, times: Floats, others: Floats, period: float) -> Floats:
        """K (k, m) between two sets of times."""
        turn = np.sin(np.pi * (times[:, None] - others) / period) * period / (np.pi * self.length)
        return self.discrepancy**2 * np.exp(-0.5 * turn**2)


@dataclass(frozen=True, eq=False)
class Block:
    """One measured curve: its name, unit, times (k,) and period in s, which may span several beats."""

    curve: str
    unit: str
    times: Floats
    period: float
    noise: Noise


@dataclass(frozen=True, eq=False)
class Data:
    """The measured values (n,), block after block.

    Raises InputError where values and times do not match in number or a value is not finite.
    """

    values: Floats
    blocks: tuple[Block, ...]

    def __post_init__(self) -> None:
        expected = sum(block.times.size for block in self.blocks)
        if self.values.shape != (expected,):
            raise InputError(f"data: {self.values.shape} values; expected ({expected},), one for each time")
        if not np.isfinite(self.values).all():
            raise InputError("data: a value is not finite: leave the sample out")

    @property
    def rows(self) -> tuple[slice, ...]:
        """Where each block's values stand."""
        ends = np.cumsum([block.times.size for block in self.blocks])
        return tuple(slice(end - block.times.size, end) for end, block in zip(ends, self.blocks, strict=True))
