r"""Mean and covariance of a few random vectors, and the distribution of the next one.

With mean b and covariance S of N normal vectors, the next one has the covariance :math:`S (1 + 1/N)`, and its
component i lies with probability p within

.. math:: b_i \pm t_{N-1, (1+p)/2} \sqrt{S_{ii} (1 + 1/N)} .

N vectors of more than N - 1 components have a singular S. Shrinking its correlations,

.. math:: r^*_{ij} = (1 - \lambda) r_{ij}, \quad
    \lambda = \sum_{i \ne j} \widehat{\mathrm{Var}}(r_{ij}) \Big/ \sum_{i \ne j} r_{ij}^2 ,

makes it positive definite and leaves the variances, hence the intervals, as they are; a shrinkage towards a multiple of
the identity (Ledoit and Wolf) would widen some intervals and narrow others.

`sensor_scatter` applies this to the parameters of the image sensors, fitted to sequences of known truth. A noise model
describes the effect of imaging as noise about a bias; the sensors describe it as mechanisms of the measurement, and
their scatter over the sequences is the prior of shrinkage, smoothing and delay.

Reference: Schafer J, Strimmer K 2005, doi 10.2202/1544-6115.1175, target D.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.observation.beat import fit_sensors
from heartfit.observation.operator import Pair


@dataclass(frozen=True, eq=False)
class Scatter:
    """Mean (m,) and covariance (m, m) of ``count`` vectors whose components have names (m,)."""

    names: tuple[str, ...]
    count: int
    mean: Floats
    covariance: Floats

    @classmethod
    def from_sample(cls, names: Sequence[str], sample: Floats, shrunk: bool = False) -> "Scatter":
        """Estimate the scatter of a sample (N, m), with shrunken correlations if ``shrunk``."""
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
        """Covariance (m, m) of the next vector about the mean, including that of the mean itself."""
        covariance: Floats = self.covariance * (1.0 + 1.0 / self.count)
        return covariance

    def half_width(self, level: float = 0.95) -> Floats:
        """Half-width (m,) of the interval of the next vector about the mean at probability ``level``, by component."""
        from scipy.special import stdtrit  # many jobs import noise models, few need intervals

        quantile = stdtrit(self.count - 1, 0.5 * (1.0 + level))
        half_width: Floats = quantile * np.sqrt(np.diag(self.predictive))
        return half_width


def shrinkage(sample: Floats) -> float:
    """Intensity lambda, 0 to 1, for a sample (N, m); constant components have no correlation."""
    count = len(sample)
    deviation = sample - sample.mean(axis=0)
    sd = deviation.std(axis=0, ddof=1)
    normal = deviation / np.where(sd > 0.0, sd, 1.0)
    products = normal[:, :, None] * normal[:, None, :]
    correlation = products.sum(axis=0) / (count - 1)
    variance = products.var(axis=0) * count**2 / (count - 1) ** 3
    off_diagonal = ~np.eye(len(correlation), dtype=bool)
    size = float((correlation[off_diagonal] ** 2).sum())
    return min(1.0, float(variance[off_diagonal].sum()) / size) if size > 0.0 else 1.0


def sensor_scatter(pairs: Sequence[Pair]) -> Scatter:
    """Mean and covariance of the fitted shrinkage [1], smoothing [s] and delay [s], one fit for each pair.

    The true volume is resampled at as many equidistant times as there are frames. Smoothing is bounded below by zero,
    so noisy frames without smoothing fit a few milliseconds. Raises InputError for fewer than two pairs.
    """
    if len(pairs) < 2:
        raise InputError(f"sensors: {len(pairs)} sequences; expected two or more: simulate and register more")
    fits = [_fit_pair(pair) for pair in pairs]
    return Scatter.from_sample(tuple(fits[0]), np.array([list(fit.values()) for fit in fits]))


def _fit_pair(pair: Pair) -> dict[str, float]:
    true, measured = (reading.curves["lv_volume"] for reading in (pair.true, pair.measured))
    return fit_sensors(true.resampled(true.times.size), measured)
