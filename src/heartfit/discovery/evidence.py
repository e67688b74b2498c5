r"""The evidence of a hypothesis by Laplace's approximation, exact for a linear model.

About any point x, with the residual r = y - f(x) and the Jacobian J, a linear model has the posterior N(m, H^-1),

.. math:: H = I + J^T \Sigma^{-1} J, \quad m = x + H^{-1} g, \quad g = J^T \Sigma^{-1} r - x,

.. math:: \ln Z = \ln N(r; 0, \Sigma) - \tfrac12 |x|^2 + \tfrac12 g^T H^{-1} g - \tfrac12 \ln |H|
          + \sum_{a \ge 0} \ln 2 \Phi(m_a / \sigma_a),

the last sum over the one-sided coordinates with their posterior standard deviations: where the half of the posterior
that is cut off matters, at most by a factor 2. An amplitude held at 0 by its bound has m_a < 0, a posterior that the
bound cuts to its tail. Z is averaged over the levels of the noise. Two one-sided coordinates count as independent.

References: Kass and Raftery 1995, doi:10.1080/01621459.1995.10476572.
"""

from dataclasses import dataclass
from functools import reduce

import numpy as np
from scipy.special import log_ndtr, logsumexp

from heartfit.discovery.whitening import Whitening
from heartfit.geometry.arrays import Floats


@dataclass(frozen=True, eq=False)
class Posterior:
    """ln Z, and the Gaussian N(mean (d,), covariance (d, d)) of the coordinates before any bound cuts it."""

    log_evidence: float
    mean: Floats
    covariance: Floats


def posterior(
    whitening: Whitening, x: Floats, residual: Floats, jacobian: Floats, one_sided: np.ndarray
) -> Posterior:
    """The posterior of the model that is linear about x: coordinates (d,), residual (n,), Jacobian (n, d)."""
    gram, peak = _over_all_levels(whitening, residual, jacobian)
    covariance = np.linalg.inv(np.eye(x.size) + gram[:, 1:, 1:])
    slope = gram[:, 1:, 0] - x
    step = np.einsum("cij,cj->ci", covariance, slope)
    sd = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2))
    beyond = log_ndtr((x + step) / sd) + np.log(2.0)
    log_z = peak - 0.5 * gram[:, 0, 0] - 0.5 * x @ x + 0.5 * np.sum(step * slope, axis=1)
    log_z += 0.5 * np.linalg.slogdet(covariance)[1] + beyond[:, one_sided].sum(axis=1)
    weight = np.exp(log_z - logsumexp(log_z))
    mean = x + weight @ step
    return Posterior(float(logsumexp(log_z) - np.log(log_z.size)), mean, np.tensordot(weight, covariance, 1))


def _over_all_levels(whitening: Whitening, residual: Floats, jacobian: Floats) -> tuple[Floats, Floats]:
    """Gram matrices (c, d + 1, d + 1) and densities at zero (c,) of every combination of the blocks' levels."""
    pairs = zip(whitening.grams(residual, jacobian), whitening.peaks, strict=True)
    return reduce(_combined, pairs)


def _combined(some: tuple[Floats, Floats], more: tuple[Floats, Floats]) -> tuple[Floats, Floats]:
    size = some[0].shape[-1]
    gram = (some[0][:, None] + more[0][None]).reshape(-1, size, size)
    return gram, (some[1][:, None] + more[1][None]).ravel()
