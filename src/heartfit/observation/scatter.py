r"""Mean and covariance of a few random vectors, and what they say of the next one.

With mean b and covariance S of N normal vectors, the next one has the covariance :math:`S (1 + 1/N)`, and its
component i lies with probability p within

.. math:: b_i \pm t_{N-1, (1+p)/2} \sqrt{S_{ii} (1 + 1/N)} .

N vectors of more than N - 1 components have a singular S. Shrinking its correlations,

.. math:: r^*_{ij} = (1 - \lambda) r_{ij}, \quad
    \lambda = \sum_{i \ne j} \widehat{\mathrm{Var}}(r_{ij}) \Big/ \sum_{i \ne j} r_{ij}^2 ,

makes it positive definite and leaves the variances, hence the intervals, as they are; a shrinkage towards a multiple of
the identity (Ledoit and Wolf) would widen the one and narrow the other.

Reference: Schafer J, Strimmer K 2005, doi 10.2202/1544-6115.1175, target D.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats


@dataclass(frozen=True, eq=False)
class Scatter:
    """Mean (m,) and covariance (m, m) of ``count`` vectors whose components have names (m,)."""

    names: tuple[str, ...]
    count: int
    mean: Floats
    covariance: Floats

    @classmethod
    def of(cls, names: Sequence[str], sample: Floats, shrunk: bool = False) -> "Scatter":
        """The scatter of a sample (N, m); shrunk: with shrunken correlations."""
        covariance = np.atleast_2d(np.cov(sample, rowvar=False))
        if shrunk:
            factor = 1.0 - shrinkage(sample)
            covariance = factor * covariance + (1.0 - factor) * np.diag(np.diag(covariance))
        return cls(tuple(names), len(sample), sample.mean(axis=0), covariance)

    @property
    def sd(self) -> Floats:
        """Standard deviations (m,)."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def predictive(self) -> Floats:
        """Covariance (m, m) of the next vector about the mean: that of the mean itself included."""
        covariance: Floats = self.covariance * (1.0 + 1.0 / self.count)
        return covariance

    def reach(self, level: float = 0.95) -> Floats:
        """How far (m,) from the mean the components of the next vector lie with probability ``level``."""
        from scipy.special import stdtrit  # every job knows noise models, few ask how far they reach

        quantile = stdtrit(self.count - 1, 0.5 * (1.0 + level))
        reach: Floats = quantile * np.sqrt(np.diag(self.predictive))
        return reach


def shrinkage(sample: Floats) -> float:
    """The intensity lambda, 0 to 1, for a sample (N, m); components that do not vary have no correlation."""
    count = len(sample)
    deviation = sample - sample.mean(axis=0)
    sd = deviation.std(axis=0, ddof=1)
    normal = deviation / np.where(sd > 0.0, sd, 1.0)
    products = normal[:, :, None] * normal[:, None, :]
    correlation = products.sum(axis=0) / (count - 1)
    variance = products.var(axis=0) * count**2 / (count - 1) ** 3
    apart = ~np.eye(len(correlation), dtype=bool)
    size = float((correlation[apart] ** 2).sum())
    return min(1.0, float(variance[apart].sum()) / size) if size > 0.0 else 1.0
