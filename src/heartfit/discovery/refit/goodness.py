r"""Goodness of a refit, curve by curve, over all samples: those that it fits and those that it leaves out.

With the slopes A of all samples at the estimate, their noise R and the fitted rows F, the residual is linear in the
measurement y,

.. math:: r = G y, \qquad G = 1 - A C A_F^T R_F^{-1} S_F, \qquad C = (1 + A_F^T R_F^{-1} A_F)^{-1},

where :math:`S_F` selects the fitted rows. A correct model gives it the covariance :math:`\Sigma = G (R + A A^T) G^T`,
the prior included: below R in the fitted samples, which the parameters follow, and above it in the others. So

.. math:: \frac{1}{g}\, r_c^T R_c^{-1} r_c \sim \chi^2_\nu, \qquad g \nu = \mathrm{tr}\, M, \quad
          g^2 \nu = \mathrm{tr}\, M^2, \quad M = R_c^{-1} \Sigma_c

for the samples of curve c, a sum of weighted squares with the mean and the variance of that distribution; a
probability of 1 % is then one of 1.0 to 1.4 %. Samples that are all fitted by k parameters without a prior have g = 1
and nu = n - k. (The sum in units of Sigma would have exactly n degrees of freedom, but along directions that the
parameters fit well it divides by almost nothing, so that a descent that ended early would look like a misfit.)

Reference: Satterthwaite 1946, doi:10.2307/3002019.
"""

from collections.abc import Iterator

import numpy as np
from scipy.special import gammaincc

from heartfit.core.arrays import Floats
from heartfit.discovery.refit.refit import Refit
from heartfit.discovery.refit.target import Target
from heartfit.discovery.sphere_model.cause import CurveFit


def curve_fits(fit: Refit, target: Target, complete: Target, predicted: Floats) -> Iterator[CurveFit]:
    """Yield the chi-squared of each curve; none without all slopes.

    target: the fitted samples; complete: all samples (m,) of their curves; predicted (m,): these at the estimate.
    """
    slopes = fit.complete_slopes
    if np.isnan(slopes).any():
        return
    residual = complete.values() - predicted
    expected = _residual_covariance(slopes, complete.rows_of(target.samples), complete.covariance)
    start = 0
    for name, samples in complete.samples.items():
        rows = slice(start, start := start + samples.times.size)
        noise = complete.covariance[rows, rows]
        ratio = np.linalg.solve(noise, expected[rows, rows])
        mean, square = float(np.trace(ratio)), float(np.sum(ratio * ratio.T))
        chi_squared = float(residual[rows] @ np.linalg.solve(noise, residual[rows])) * mean / square
        freedom = mean**2 / square
        yield CurveFit(name, chi_squared, freedom, float(gammaincc(0.5 * freedom, 0.5 * chi_squared)))


def _residual_covariance(slopes: Floats, fitted: np.ndarray, noise: Floats) -> Floats:
    """Sigma (m, m) of slopes A (m, d), fitted rows F (m,) and noise R (m, m)."""
    weighted = np.linalg.solve(noise[np.ix_(fitted, fitted)], slopes[fitted])
    gain = np.linalg.solve(np.eye(slopes.shape[1]) + slopes[fitted].T @ weighted, weighted.T)
    residual = np.eye(len(slopes))
    residual[:, fitted] -= slopes @ gain
    covariance: Floats = residual @ (noise + slopes @ slopes.T) @ residual.T
    return covariance
