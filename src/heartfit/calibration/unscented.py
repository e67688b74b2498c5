"""Forward models that count or cache their simulations, sigma points, and the moments of the observations.

With n parameters X ~ N(X0, C), lambda = a^2 (n + kappa) - n and gamma = sqrt(n + lambda):

    X_0 = X0,   X_(i+-) = X0 +- gamma (sqrt C)_i,   i = 1..n
    W_0^m = lambda / (n + lambda),   W_0^c = W_0^m + 1 - a^2 + b,   W_i = 1 / (2 (n + lambda))
    Zbar = sum W^m Z
    Cov(X, Z) = sum W^c (X - X0)(Z - Zbar)^T,   Cov(Z, Z) = sum W^c (Z - Zbar)(Z - Zbar)^T

References: Wan and van der Merwe 2000, doi:10.1109/ASSPCC.2000.882463; Marchesseau et al. 2012, eqs (2) and
(4).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.calibration.design import CalibrationError as CalibrationError
from heartfit.calibration.design import Design
from heartfit.calibration.design import Scaling as Scaling
from heartfit.calibration.gaussian import Gaussian

Outcome = Mapping[str, float] | str
"""Observations by name, or the reason of a failure."""
Forward = Callable[[Sequence[Mapping[str, float]]], list[Outcome]]
"""Map from the parameters of some simulations, by name [SI], to their outcomes."""


class CountedForward:
    """A forward model that counts its simulations."""

    def __init__(self, forward: Forward) -> None:
        self._forward, self.simulations = forward, 0

    def __call__(self, parameters: Sequence[Mapping[str, float]]) -> list[Outcome]:
        self.simulations += len(parameters)
        return self._forward(parameters)


class CachedForward:
    """A forward model that simulates no parameters twice: hearts with the same shape and prior share sigma points."""

    def __init__(self, forward: Forward) -> None:
        self._forward, self._known = forward, dict[frozenset[tuple[str, float]], Outcome]()

    def __call__(self, parameters: Sequence[Mapping[str, float]]) -> list[Outcome]:
        keys = [frozenset(values.items()) for values in parameters]
        new = {key: values for key, values in zip(keys, parameters, strict=True) if key not in self._known}
        self._known |= zip(new, self._forward(list(new.values())), strict=True)
        return [self._known[key] for key in keys]


STANDARD_DESIGN = Scaling()


@dataclass(frozen=True)
class SigmaPoint:
    """Parameters to simulate: number, label ("centre", "sigma_0+", ...), z (n,) and theta = exp(z)."""

    index: int
    label: str
    z: np.ndarray
    parameters: dict[str, float]


def sigma_points(prior: Gaussian, design: Design = STANDARD_DESIGN) -> list[SigmaPoint]:
    """Return the points of the design under the prior, in its order; by default the 2n+1 points of the module."""
    z = prior.mean + design.offsets(len(prior.names)) @ np.linalg.cholesky(prior.covariance).T
    return [
        SigmaPoint(index, label, z[index], prior.physical(z[index]))
        for index, label in enumerate(design.labels(prior.names))
    ]


@dataclass(frozen=True)
class Moments:
    """Zbar (m,), Cov(X, Z) (n, m), Cov(Z, Z) (m, m), and the labels of the failed points."""

    mean: np.ndarray
    cov_xz: np.ndarray
    cov_zz: np.ndarray
    failed: tuple[str, ...] = ()


def transform(
    points: Sequence[SigmaPoint],
    z: np.ndarray,
    design: Design = STANDARD_DESIGN,
    completed: np.ndarray | None = None,
) -> Moments:
    """Return the moments of the observations z (p, m); rows with `completed` (p,) False are ignored.

    The design replaces these rows such that the moments of a linear map remain exact. Of the 2n+1 points, a failed
    X_(i+) is replaced by the mirror image Z_(i+) = 2 Z_0 - Z_(i-), a failed centre by the mean of the complete pairs.
    The joint covariance remains positive. Raises CalibrationError if too many points failed.
    """
    labels = [point.label for point in points]
    x = np.array([point.z for point in points])
    complete = np.ones(len(points), dtype=bool) if completed is None else np.asarray(completed, dtype=bool)
    _check_observations(z, complete, labels)
    z = design.filled(z, complete, labels)
    mean_weight, weight = design.weights(x.shape[1])
    mean = mean_weight @ z
    deviation = z - mean
    return Moments(
        mean,
        (weight[:, None] * (x - x[0])).T @ deviation,
        (weight[:, None] * deviation).T @ deviation,
        tuple(label for label, ok in zip(labels, complete, strict=True) if not ok),
    )


def _check_observations(z: np.ndarray, complete: np.ndarray, labels: list[str]) -> None:
    if z.ndim != 2 or len(z) != len(labels) or complete.shape != (len(labels),):
        raise ValueError(
            f"unscented: observations {z.shape}, mask {complete.shape}; expected {len(labels)} rows"
        )
    bad = [
        label for label, row, ok in zip(labels, z, complete, strict=True) if ok and not np.isfinite(row).all()
    ]
    if bad:
        raise ValueError(
            f"unscented: {', '.join(bad)} observed as not finite; expected numbers, or a mask that says "
            "they failed"
        )
