"""A hypothesis after its fit: how much the data speak for it, and what it says of its coordinates."""

from dataclasses import dataclass

import numpy as np
from scipy.special import ndtr, ndtri

from heartfit.discovery.evidence import Posterior, posterior
from heartfit.discovery.optimise import Fit
from heartfit.discovery.whitening import Whitening
from heartfit.geometry.arrays import Floats


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
        """Median, least and largest value of a coordinate; that of a one-sided one is cut off at 0."""
        index = self.fit.hypothesis.names.index(name)
        mean, sd = self.posterior.mean[index], np.sqrt(self.posterior.covariance[index, index])
        below = ndtr(-mean / sd) if self.fit.hypothesis.coordinates[index].one_sided else 0.0
        ranks = below + (1.0 - below) * np.array([0.5, 0.5 - 0.5 * level, 0.5 + 0.5 * level])
        middle, low, high = (mean + sd * ndtri(ranks)).tolist()
        return middle, low, high


def linear(fit: Fit, values: Floats, whitening: Whitening) -> Posterior:
    """The posterior of the model that is linear about the fit, under this noise."""
    return posterior(whitening, fit.x, values - fit.predicted, fit.jacobian, fit.hypothesis.one_sided)
