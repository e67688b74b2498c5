r"""The unscented step repeated about the last estimate.

The points of step k lie about the last estimate x_k with the covariance P_k and make the model linear there,

.. math:: Z \approx \bar Z_k + A_k (X - x_k) + e, \quad A_k = \mathrm{Cov}(Z, X) P_k^{-1}, \quad
          e \sim N(0,\, \mathrm{Cov}(Z, Z) - A_k P_k A_k^T) .

The estimate then is that of this model and the ORIGINAL prior, never of the last posterior: the data are used once.
With R = 0 the fixed point meets the observations by the least prior-weighted change, with R > 0 it is the maximum a
posteriori of a Gauss-Newton method whose slopes are statistical. P_k = s^(2k) C shrinks by s a step, so that the last
slopes are those at the estimate. The first step is that of :func:`heartfit.calibration.update.calibrate`, to the bit
of rounding.

References: Bell and Cathey 1993, doi:10.1109/9.250476; Garcia-Fernandez et al. 2015, doi:10.1109/TSP.2015.2454485.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from heartfit.calibration.design import Design
from heartfit.calibration.forward import Forward
from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import STANDARD, Moments, sigma_points
from heartfit.calibration.update import Posterior, moments_of, update


def iterated(
    prior: Gaussian,
    forward: Forward,
    observed: Mapping[str, float],
    noise: np.ndarray | None = None,
    design: Design = STANDARD,
    shrink: float = 0.5,
    start: Gaussian | None = None,
) -> Iterator[Posterior]:
    """The posteriors of step 1, 2, ... without end, each for as many simulations as the design has points.

    start: what the points of the first step are drawn from, the prior if None; its spread is what shrinks. Raises
    CalibrationError where too many points about an estimate fail.
    """
    first = around = prior if start is None else start
    spread = 1.0
    while True:
        outcomes = forward([point.parameters for point in sigma_points(around, design)])
        seen = moments_of(around, outcomes, tuple(observed), design)
        posterior = update(prior, under(prior, around, seen), observed, noise)
        yield posterior
        spread *= shrink**2
        around = Gaussian(prior.names, posterior.estimate.mean, spread * first.covariance)


def under(prior: Gaussian, around: Gaussian, seen: Moments) -> Moments:
    """Moments under the prior of the linear model that the moments `seen` around another Gaussian give."""
    slope = np.linalg.solve(around.covariance, seen.cov_xz)
    bent = seen.cov_zz - slope.T @ around.covariance @ slope
    cov_xz = prior.covariance @ slope
    mean = seen.mean + (prior.mean - around.mean) @ slope
    return Moments(mean, cov_xz, slope.T @ cov_xz + bent, seen.failed)
