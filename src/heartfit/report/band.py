r"""How far the calibrated curves are known, from the beats that the calibration rests on.

.. math:: V(t) = S(t)^T C_{post} S(t), \qquad S(t) = C^{-1} Cov(X, y(t))

Cov(X, y(t)) over the sigma points is that of the unscented transform, taken of a whole curve instead of the
observations; C is the prior's covariance and C_post the posterior's, of logarithms.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import CalibrationError, SigmaPoint, transform
from heartfit.observation.curve import Curve

Curves = Mapping[str, Curve]


def band(
    prior: Gaussian, points: Sequence[SigmaPoint], beats: Sequence[Curves], estimate: Gaussian, around: Curves
) -> dict[str, Curve]:
    """Standard deviation of each volume and pressure of ``around``, SI, at its times; nothing where too many failed.

    beats: the curves of each sigma point, none of a failed one.
    """
    completed = np.array([bool(beat) for beat in beats])
    found = {}
    for name in [each for each in around if each.endswith(("_volume", "_pressure"))]:
        times = around[name].times
        values = np.array([beat[name](times) if beat else np.zeros(len(times)) for beat in beats])
        try:
            moments = transform(points, values, completed=completed)
        except CalibrationError:
            return {}
        slopes = np.linalg.solve(prior.covariance, moments.cov_xz)
        sd = np.sqrt(np.einsum("it,ij,jt->t", slopes, estimate.covariance, slopes))
        found[name] = Curve(times, sd, around[name].period)
    return found
