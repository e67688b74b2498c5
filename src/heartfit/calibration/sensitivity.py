r"""Normalised covariance of parameters and observations, and the uncertainty due to fixed parameters.

**Fixed parameters.** A parameter p_j is fixed at its mean, although its logarithm has the standard deviation s_j. The
resulting scatter of the observations is noise of the model; to first order

.. math:: R_{fixed} = \sum_j s_j^2\, \frac{\partial Z}{\partial \ln p_j}
          \Big(\frac{\partial Z}{\partial \ln p_j}\Big)^T .

**Normalised Cov(X, Z)** of all parameters, from one beat at the prior's mean and two for each parameter. With
z = ln theta, prior standard deviations s_i and points at h s_i on either side of the mean,

    Cov(X, Z)_ij = s_i (Z_j(i+) - Z_j(i-)) / (2 h),   sd(Z_j)^2 = sum_i (Cov(X, Z)_ij / s_i)^2,
    A_ij = Cov(X, Z)_ij / (s_i sd(Z_j)).

The squares of a column of A add up to one: each is the share of that observation's variance, to first order, that the
parameter causes. The unscented transform would place the points of n = 14 parameters at h = sqrt(14) = 3.7, where
alpha is 4.5 times its mean or a quarter of it. The covariance of an odd pair does not depend on the weight of the
centre, so h is free; one standard deviation is also the distance in the calibration.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import CalibrationError, Outcome, Scaling, SigmaPoint, transform
from heartfit.calibration.update import SILENT_VARIATION
from heartfit.core.errors import InputError


def covariance_of_fixed(slopes: np.ndarray, sds: np.ndarray) -> np.ndarray:
    """R_fixed (m, m) from the slopes dZ/dln p_j (k, m) and the standard deviations s_j (k,), added to R of the images.

    Zero without fixed parameters. Raises ValueError for inconsistent shapes and non-finite values.
    """
    if slopes.ndim != 2 or sds.shape != (len(slopes),):
        raise ValueError(f"fixed: slopes {slopes.shape}, deviations {sds.shape}; expected (k, m) and (k,)")
    scaled = slopes * sds[:, None]
    if not np.isfinite(scaled).all():
        raise ValueError("fixed: a slope or a deviation is not finite; expected numbers: did a beat fail?")
    return scaled.T @ scaled


@dataclass(frozen=True, eq=False)
class Slopes:
    """Relative derivatives dln Z / dln p (k, m) of the observations of one heart, by parameter and observation."""

    parameters: tuple[str, ...]
    observations: tuple[str, ...]
    relative: np.ndarray

    @classmethod
    def from_parts(cls, parts: "Sequence[Sensitivity]") -> Self:
        """Return the slopes of different observations with respect to the same parameters."""
        observations = tuple(name for part in parts for name in part.observations)
        return cls(parts[0].parameters, observations, np.hstack([part.slopes for part in parts]))

    def covariance(self, estimated: Collection[str], observed: Mapping[str, float], sd: float) -> np.ndarray:
        """R_fixed (m, m), in the units and order of `observed`, of all parameters that are not estimated.

        All hearts are assumed to have the same relative derivatives. Raises InputError for an observation without
        slopes, or with one that is not a number.
        """
        unknown = sorted(set(observed) - set(self.observations))
        if unknown:
            raise InputError(
                f"slopes: no observation {', '.join(unknown)}; there are {', '.join(self.observations)}"
            )
        rows = [row for row, name in enumerate(self.parameters) if name not in estimated]
        columns = [self.observations.index(name) for name in observed]
        slopes = self.relative[np.ix_(rows, columns)] * np.array(list(observed.values()))
        if not np.isfinite(slopes).all():
            bad = [
                self.parameters[row]
                for row, slope in zip(rows, slopes, strict=True)
                if not np.isfinite(slope).all()
            ]
            raise InputError(
                f"slopes: {', '.join(bad)} not a number; expected completed beats on both sides of it"
            )
        return covariance_of_fixed(slopes, np.full(len(rows), sd))


@dataclass(frozen=True)
class Sensitivity:
    """Effect of n parameters on m observations about the prior.

    covariance (n, m): A of the module; slopes (n, m): d ln Z / d ln theta, exact for a pure power law; centre (m,): Z
    at the mean, SI; failed: points without a beat, with reasons.
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
        """Columns (n, k) of A of some observations, in their order."""
        return self.covariance[:, [self.observations.index(name) for name in observations]]

    def with_sd(self, sd: Sequence[float]) -> Self:
        """Return the same slopes with other standard deviations (n,) of the parameters."""
        variance = np.diag(np.square(sd))
        effects = self.slopes * np.asarray(sd)[:, None] * self.centre
        scale = np.linalg.norm(effects, axis=0)
        prior = Gaussian(self.prior.names, self.prior.mean, variance)
        return replace(self, prior=prior, covariance=effects / scale)


def one_at_a_time_scaling(parameters: int, step: float) -> Scaling:
    """Return the scaling that places the points at `step` standard deviations of the prior."""
    return Scaling(kappa=step**2 - parameters)


def sensitivity(
    prior: Gaussian,
    points: Sequence[SigmaPoint],
    outcomes: Sequence[Outcome],
    scaling: Scaling,
    observations: Sequence[str],
) -> Sensitivity:
    """Return the sensitivities of some observations from the outcome of each sigma point of the prior under `scaling`.

    A failed point is mirrored, as in `transform`. Raises CalibrationError if both points of a parameter failed, or if
    an observation is the same in all beats.
    """
    z = np.array([_row(outcome, observations) for outcome in outcomes])
    completed = np.array([not isinstance(outcome, str) for outcome in outcomes])
    labelled = [_label(point, outcome) for point, outcome in zip(points, outcomes, strict=True)]
    moments = transform(labelled, z, scaling, completed)
    centre = z[0] if completed[0] else z[completed].mean(axis=0)
    derivative = moments.cov_xz / prior.sd[:, None]  # per standard deviation of the prior
    scale = np.linalg.norm(derivative, axis=0)
    silent = [
        name
        for name, quiet in zip(observations, scale <= SILENT_VARIATION * np.abs(centre), strict=True)
        if quiet
    ]
    if silent:
        raise CalibrationError(f"sensitivity: no parameter changes {', '.join(silent)}: do not observe it")
    slopes = derivative / prior.sd[:, None] / centre
    return Sensitivity(prior, tuple(observations), centre, derivative / scale, slopes, moments.failed)


def _row(outcome: Outcome, names: Sequence[str]) -> list[float]:
    return [np.nan if isinstance(outcome, str) else outcome[name] for name in names]


def _label(point: SigmaPoint, outcome: Outcome) -> SigmaPoint:
    return replace(point, label=f"{point.label} ({outcome})") if isinstance(outcome, str) else point
