r"""An unknown effect as a rival: a smooth function of the phase beside the model.

The discrepancy of a model is a Gaussian process delta with the covariance :math:`g^2 K` of
:mod:`heartfit.discovery.data`, g one of three sizes, equally likely. The evidence is that of the fit with
:math:`\Sigma + g^2 K` in place of Sigma, the model linear about the fit: it costs no simulation. Beside no effect it is
"something, but none of these"; on top of the best effect it asks what that leaves.

The curve itself, given the data, is

.. math:: E[\delta \mid y] = g^2 K C^{-1} (y - f + J x), \quad C = \Sigma + g^2 K + J J^T,
          \quad \mathrm{Cov}[\delta \mid y] = g^2 K - g^4 K C^{-1} K ,

at the most probable size and levels of the noise.

References: Kennedy and O'Hagan 2001, doi:10.1111/1467-9868.00294; Berger and Guglielmi 2001,
doi:10.1198/016214501750333045.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag, cho_factor, cho_solve
from scipy.special import logsumexp

from heartfit.discovery.data import Block, Data
from heartfit.discovery.explanation import linear
from heartfit.discovery.optimise import Fit
from heartfit.discovery.whitening import Whitening
from heartfit.geometry.arrays import Floats

SIZES = (0.4, 1.0, 2.5)
"""g: from what hides in the noise of one curve to what nobody overlooks."""


@dataclass(frozen=True, eq=False)
class Discrepancy:
    """What a model lacks of one curve: mean (k,) and standard deviation (k,) in its unit at the block's times."""

    block: Block
    mean: Floats
    sd: Floats


@dataclass(frozen=True, eq=False)
class Rival:
    """The data's whitenings under each size of the discrepancy."""

    data: Data
    whitenings: tuple[Whitening, ...]

    @classmethod
    def of(cls, data: Data) -> "Rival":
        return cls(data, tuple(Whitening.of(data, size) for size in SIZES))

    def log_evidence(self, fit: Fit) -> float:
        """ln Z of the discrepancy beside the fitted hypothesis."""
        return float(logsumexp(self._by_size(fit)) - np.log(len(SIZES)))

    def curves(self, fit: Fit) -> tuple[Discrepancy, ...]:
        """What the fitted hypothesis lacks, block after block."""
        best = int(np.argmax(self._by_size(fit)))
        at_centre = self.data.values - fit.predicted + fit.jacobian @ fit.x
        levels = self.whitenings[best].likeliest(self.data.values - fit.predicted)
        return _curves(self.data, at_centre, fit.jacobian, SIZES[best], levels)

    def _by_size(self, fit: Fit) -> list[float]:
        return [linear(fit, self.data.values, each).log_evidence for each in self.whitenings]


def _curves(
    data: Data, at_centre: Floats, jacobian: Floats, size: float, levels: list[int]
) -> tuple[Discrepancy, ...]:
    smooth = [
        size**2 * each.noise.discrepancy_covariance(each.times, each.times, each.period)
        for each in data.blocks
    ]
    noise = [
        each.noise.covariance(each.times, each.period, each.noise.levels[level])
        for each, level in zip(data.blocks, levels, strict=True)
    ]
    K = block_diag(*smooth)
    factor = cho_factor(block_diag(*noise) + K + jacobian @ jacobian.T)
    mean = K @ cho_solve(factor, at_centre)
    variance = np.diag(K) - np.einsum("ij,ji->i", K, cho_solve(factor, K))
    sd = np.sqrt(np.maximum(variance, 0.0))
    return tuple(
        Discrepancy(block, mean[rows], sd[rows]) for block, rows in zip(data.blocks, data.rows, strict=True)
    )
