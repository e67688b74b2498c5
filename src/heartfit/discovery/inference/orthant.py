r"""Share of a Gaussian posterior in which one-sided coordinates are not negative.

Of one coordinate with mean m and standard deviation s it is :math:`\Phi(m / s)`; of two with the correlation r

.. math:: \int_{-m_1/s_1}^\infty \varphi(z) \, \Phi\!\left(\frac{m_2/s_2 + r z}{\sqrt{1 - r^2}}\right) dz .

The integrand is log-concave: its range is narrowed about the peak until the nodes resolve it, so the logarithm holds in
tails that a cumulative distribution function rounds to zero. More than two, the values of one-sided functions of a
place, count as independent.
"""

import numpy as np
from scipy.special import log_ndtr, logsumexp

from heartfit.core.arrays import Floats

NODES, WEIGHTS = (
    0.5 * (part + shift) for part, shift in zip(np.polynomial.legendre.leggauss(32), (1, 0), strict=True)
)
"""Gauss and Legendre's quadrature from 0 to 1."""
NARROWINGS = 4
"""Number of times that the range is narrowed."""
FARTHEST = 40.0
"""Length [standard deviations] of the first range beyond the bound or the mean."""
NEGLIGIBLE = 30.0
"""Logarithm below the peak from which the integrand is left out."""
LARGEST_CORRELATION = 1.0 - 1e-9


def log_share(mean: Floats, covariance: Floats) -> Floats:
    """ln of the share (...,) of N(mean (..., k), covariance (..., k, k)) without a negative coordinate."""
    sd = np.sqrt(np.diagonal(covariance, axis1=-2, axis2=-1))
    reduced = mean / sd
    if mean.shape[-1] == 2:
        correlation = covariance[..., 0, 1] / sd.prod(axis=-1)
        return _log_quadrant(reduced[..., 0], reduced[..., 1], correlation)
    independent: Floats = log_ndtr(reduced).sum(axis=-1)
    return independent


def _log_quadrant(first: Floats, second: Floats, correlation: Floats) -> Floats:
    """ln of the share (...,) of standard bivariate normals above (-first, -second)."""
    r = np.clip(correlation, -LARGEST_CORRELATION, LARGEST_CORRELATION)[..., None]
    second, low = (
        np.broadcast_to(second, r.shape[:-1])[..., None],
        -np.broadcast_to(first, r.shape[:-1])[..., None],
    )
    high = np.maximum(low, 0.0) + FARTHEST
    for _ in range(NARROWINGS):
        z = low + (high - low) * NODES
        density = -0.5 * z**2 + log_ndtr((second + r * z) / np.sqrt(1.0 - r**2))
        length, kept = high - low, density > density.max(axis=-1, keepdims=True) - NEGLIGIBLE
        ends = np.concatenate([low, z, high], axis=-1)
        before = np.argmax(kept, axis=-1)[..., None]
        after = NODES.size + 1 - np.argmax(kept[..., ::-1], axis=-1)[..., None]
        low, high = (np.take_along_axis(ends, place, axis=-1) for place in (before, after))
    total: Floats = logsumexp(density, b=WEIGHTS * length, axis=-1) - 0.5 * np.log(2.0 * np.pi)
    return total
