"""Normalised Cov(X, Z) of all parameters from one beat at the prior's mean and two for each parameter.

With z = ln theta, prior standard deviations s_i and points at h s_i on either side of the mean,

    Cov(X, Z)_ij = s_i (Z_j(i+) - Z_j(i-)) / (2 h),   sd(Z_j)^2 = sum_i (Cov(X, Z)_ij / s_i)^2,
    A_ij = Cov(X, Z)_ij / (s_i sd(Z_j)).

The squares of a column of A add up to one: each is the share of that observation's variance, to first order,
which the parameter is to blame for. The unscented transform would put the points of n = 14 parameters at
h = sqrt(14) = 3.7, where alpha is 4.5 times its mean or a quarter of it. The covariance of an odd pair does not
depend on the weight of the centre, so h is free; one standard deviation is where the calibration looks too.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from heartfit.calibration.forward import Outcome
from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import CalibrationError, Scaling, SigmaPoint, transform
from heartfit.calibration.update import SILENT


@dataclass(frozen=True)
class Sensitivity:
    """What n parameters do to m observations about the prior.

    covariance (n, m): A, see above; slopes (n, m): d ln Z / d ln theta, exact for a pure power law; centre (m,): Z at
    the mean, SI; failed names the points without a beat, each with the reason.
    """

    prior: Gaussian
    observations: tuple[str, ...]
    centre: np.ndarray
    covariance: np.ndarray
    slopes: np.ndarray
    failed: tuple[str, ...] = ()

    @property
    def parameters(self) -> tuple[str, ...]:
        """Names of the rows."""
        return self.prior.names

    def of(self, observations: Sequence[str]) -> np.ndarray:
        """The columns (n, k) of A that belong to some observations, in their order."""
        return self.covariance[:, [self.observations.index(name) for name in observations]]

    def with_sd(self, sd: Sequence[float]) -> Self:
        """The same slopes under other standard deviations (n,) of the parameters."""
        variance = np.diag(np.square(sd))
        moved = self.slopes * np.asarray(sd)[:, None] * self.centre
        scale = np.linalg.norm(moved, axis=0)
        prior = Gaussian(self.prior.names, self.prior.mean, variance)
        return replace(self, prior=prior, covariance=moved / scale)


def surrounding(parameters: int, step: float) -> Scaling:
    """The scaling that puts the points at `step` standard deviations of the prior."""
    return Scaling(kappa=step**2 - parameters)


def sensitivity(
    prior: Gaussian,
    points: Sequence[SigmaPoint],
    outcomes: Sequence[Outcome],
    scaling: Scaling,
    observations: Sequence[str],
) -> Sensitivity:
    """Sensitivities of some observations from the outcome of each sigma point of the prior under `scaling`.

    A point that failed is mirrored, as `transform` does. Raises CalibrationError if both points of a parameter
    did, or if an observation is the same in all beats.
    """
    z = np.array([_row(outcome, observations) for outcome in outcomes])
    done = np.array([not isinstance(outcome, str) for outcome in outcomes])
    labelled = [_labelled(point, outcome) for point, outcome in zip(points, outcomes, strict=True)]
    moments = transform(labelled, z, scaling, done)
    centre = z[0] if done[0] else z[done].mean(axis=0)
    derivative = moments.cov_xz / prior.sd[:, None]  # by parameters in standard deviations of the prior
    scale = np.linalg.norm(derivative, axis=0)
    silent = [
        name for name, quiet in zip(observations, scale <= SILENT * np.abs(centre), strict=True) if quiet
    ]
    if silent:
        raise CalibrationError(f"sensitivity: no parameter changes {', '.join(silent)}: do not observe it")
    slopes = derivative / prior.sd[:, None] / centre
    return Sensitivity(prior, tuple(observations), centre, derivative / scale, slopes, moments.failed)


def _row(outcome: Outcome, names: Sequence[str]) -> list[float]:
    return [np.nan if isinstance(outcome, str) else outcome[name] for name in names]


def _labelled(point: SigmaPoint, outcome: Outcome) -> SigmaPoint:
    return replace(point, label=f"{point.label} ({outcome})") if isinstance(outcome, str) else point
