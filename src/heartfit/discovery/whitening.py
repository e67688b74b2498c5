r"""The Gaussian likelihood of a residual whose noise level is unknown.

Blocks are independent and every level l of a block's noise is equally likely, so that

.. math:: p(r) = \prod_b \frac{1}{L_b} \sum_l N(r_b; 0, \Sigma_{bl}) .

Its logarithm has the slope of the mean precision :math:`\bar\Lambda_b = \sum_l w_l \Sigma_{bl}^{-1}`, where w are the
probabilities of the levels given r. With a discrepancy, :math:`\Sigma + g^2 K` takes the place of Sigma.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import logsumexp, softmax

from heartfit.discovery.data import Block, Data
from heartfit.geometry.arrays import Floats


@dataclass(frozen=True, eq=False)
class Whitening:
    """Inverse Cholesky factors of each block and level, (l, k, k), and the logarithms of their densities at 0, (l,)."""

    rows: tuple[slice, ...]
    roots: tuple[Floats, ...]
    peaks: tuple[Floats, ...]

    @classmethod
    def of(cls, data: Data, discrepancy: float = 0.0) -> "Whitening":
        """discrepancy: g, by how much the model may be wrong over what its blocks declare."""
        roots = tuple(_roots(block, discrepancy) for block in data.blocks)
        return cls(data.rows, roots, tuple(_peaks(root) for root in roots))

    def log_likelihood(self, residual: Floats) -> float:
        """ln p(r)."""
        return float(sum(logsumexp(level) - np.log(level.size) for level in self._levels(residual)))

    def likeliest(self, residual: Floats) -> list[int]:
        """The most probable level of each block."""
        return [int(np.argmax(level)) for level in self._levels(residual)]

    def normal(self, residual: Floats, jacobian: Floats) -> tuple[Floats, Floats]:
        """J' L r (d,) and J' L J (d, d) with the mean precision L."""
        weights = [softmax(level) for level in self._levels(residual)]
        grams = self.grams(residual, jacobian)
        mean = [np.tensordot(weight, gram, 1) for weight, gram in zip(weights, grams, strict=True)]
        total = np.sum(mean, axis=0)
        return total[1:, 0], total[1:, 1:]

    def grams(self, residual: Floats, jacobian: Floats) -> list[Floats]:
        """(r, J)' Sigma^-1 (r, J) of each block, (l, d + 1, d + 1)."""
        table = np.column_stack([residual, jacobian])
        white = [root @ table[rows] for root, rows in zip(self.roots, self.rows, strict=True)]
        return [np.swapaxes(each, 1, 2) @ each for each in white]

    def _levels(self, residual: Floats) -> list[Floats]:
        white = [root @ residual[rows] for root, rows in zip(self.roots, self.rows, strict=True)]
        return [
            peak - 0.5 * np.einsum("lk,lk->l", each, each)
            for peak, each in zip(self.peaks, white, strict=True)
        ]


def _roots(block: Block, discrepancy: float) -> Floats:
    extra = discrepancy**2 * block.noise.discrepancy_covariance(block.times, block.times, block.period)
    covariances = [
        block.noise.covariance(block.times, block.period, level) + extra for level in block.noise.levels
    ]
    factors = np.linalg.cholesky(np.array(covariances))
    return np.asarray(np.linalg.inv(factors), np.float64)


def _peaks(roots: Floats) -> Floats:
    diagonals = np.diagonal(roots, axis1=1, axis2=2)
    peaks: Floats = np.log(diagonals).sum(axis=1) - 0.5 * roots.shape[1] * np.log(2.0 * np.pi)
    return peaks
