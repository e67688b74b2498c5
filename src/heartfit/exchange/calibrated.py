"""A case under a setting, complete: what was believed, observed and simulated."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.update import Posterior
from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import Measurement
from heartfit.tables.case import CaseResult


@dataclass(frozen=True, eq=False)
class Calibrated:
    """A case with both updates, met as in the paper and weighed by the noise.

    measured, simulated: curves by name, SI, the latter at the estimate of ``met``; none of a beat that failed.
    """

    case: CaseResult
    met: Posterior
    weighed: Posterior
    measurement: Measurement
    measured: Mapping[str, Curve]
    simulated: Mapping[str, Curve]

    @property
    def beliefs(self) -> dict[str, Gaussian]:
        """Of the logarithms of the parameters: before, after the paper's step, after the one that knows the noise."""
        return {"prior": self.met.prior, "paper": self.met.estimate, "posterior": self.weighed.estimate}

    def predicted(self, z: Floats) -> Floats:
        r"""Observations (.., m) at logarithms of the parameters z (.., n), by the transform's linear map.

        .. math:: \bar Z + \mathrm{Cov}(Z, X)\, C^{-1} (z - z_0)
        """
        prior = self.weighed.prior
        slopes = np.linalg.solve(prior.covariance, self.weighed.cov_xz)
        return self.weighed.predicted + (z - prior.mean) @ slopes
