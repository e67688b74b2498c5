"""A hypothesis after its fit: how much the data speak for it, and what it says of its coordinates."""

from dataclasses import dataclass

import numpy as np
from scipy.special import ndtr, ndtri

from heartfit.discovery.evidence import Posterior, posterior
from heartfit.discovery.optimise import Fit
from heartfit.discovery.whitening import Whitening
from heartfit.geometry.arrays import Floats

WIDER = 1.2
"""What the model gets wrong beyond its noise, over the standard deviation of an amplitude: of 21 effects that were
named rightly, late activation aside, the errors have 1.12 times the size that they should, and three are beyond two."""
TOLD = 0.9
"""The largest posterior variance of a coordinate of which the data tell anything."""


@dataclass(frozen=True, eq=False)
class Explanation:
    """A fit and its posterior."""

    fit: Fit
    posterior: Posterior

    @classmethod
    def of(cls, fit: Fit, values: Floats, whitening: Whitening) -> "Explanation":
        """values: the data (n,)."""
        return cls(fit, linear(fit, values, whitening))

    @property
    def effects(self) -> tuple[str, ...]:
        return self.fit.hypothesis.effects

    @property
    def log_evidence(self) -> float:
        return self.posterior.log_evidence

    def interval(self, name: str, level: float = 0.95) -> tuple[float, float, float]:
        """Median, least and largest value of a coordinate as the data tell it; a one-sided one is cut off at 0.

        What is reported has been selected for being large: the prior that draws it back to 0 is divided out of the
        posterior N(m, v), which leaves N(m / (1 - v), v / (1 - v)), with ``WIDER`` times its standard deviation.
        """
        index = self.fit.hypothesis.names.index(name)
        variance = min(self.posterior.covariance[index, index], TOLD)
        mean = self.posterior.mean[index] / (1.0 - variance)
        sd = WIDER * np.sqrt(variance / (1.0 - variance))
        below = ndtr(-mean / sd) if self.fit.hypothesis.coordinates[index].one_sided else 0.0
        ranks = below + (1.0 - below) * np.array([0.5, 0.5 - 0.5 * level, 0.5 + 0.5 * level])
        middle, low, high = (mean + sd * ndtri(ranks)).tolist()
        return middle, low, high


def linear(fit: Fit, values: Floats, whitening: Whitening) -> Posterior:
    """The posterior of the model that is linear about the fit, under this noise."""
    return posterior(whitening, fit.x, values - fit.predicted, fit.jacobian, fit.hypothesis.one_sided)
