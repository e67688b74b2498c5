"""Sigma points, their weights, and the moments they give.

Equations, with n parameters X ~ N(X0, C), lambda = a^2 (n + kappa) - n and gamma = sqrt(n + lambda):

    X_0 = X0,   X_(i+-) = X0 +- gamma (sqrt C)_i,   i = 1..n
    W_0^m = lambda / (n + lambda),   W_0^c = W_0^m + 1 - a^2 + b,   W_i = 1 / (2 (n + lambda))
    Zbar = sum W^m Z
    Cov(X, Z) = sum W^c (X - X0)(Z - Zbar)^T,   Cov(Z, Z) = sum W^c (Z - Zbar)(Z - Zbar)^T

References: Wan and van der Merwe 2000, doi:10.1109/ASSPCC.2000.882463; Marchesseau et al. 2012, eqs (2) and
(4).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.calibration.gaussian import Gaussian
from heartfit.errors import InputError


class CalibrationError(InputError):
    """The sigma points that remain do not determine what is asked; the message says which are missing."""


@dataclass(frozen=True)
class Scaling:
    """The three free numbers of the transform.

    a = 1, kappa = 0 put the points at gamma = sqrt(n) with W_0^m = 0: far enough that the noise of q_min and
    dP/dt is not amplified by 1/a^2, near enough that every simulation stays admissible. kappa = 3 - n would
    make W_0 negative for n > 3. b = 2 is the value for a Gaussian prior.
    """

    a: float = 1.0
    b: float = 2.0
    kappa: float = 0.0

    def spread(self, n: int) -> float:
        """n + lambda = a^2 (n + kappa)."""
        spread = self.a**2 * (n + self.kappa)
        if spread <= 0:
            raise ValueError(
                f"unscented: a={self.a}, kappa={self.kappa}, n={n}; expected a^2 (n + kappa) > 0"
            )
        return spread

    def weights(self, n: int) -> tuple[np.ndarray, np.ndarray]:
        """W^m and W^c, (2n+1,) each, in the order of `sigma_points`."""
        spread = self.spread(n)
        mean = np.full(2 * n + 1, 0.5 / spread)
        mean[0] = 1 - n / spread
        covariance = mean.copy()
        covariance[0] += 1 - self.a**2 + self.b
        return mean, covariance


STANDARD = Scaling()


@dataclass(frozen=True)
class SigmaPoint:
    """Parameters to simulate: number, label ("centre", "sigma_0+", ...), z (n,) and theta = exp(z)."""

    index: int
    label: str
    z: np.ndarray
    parameters: dict[str, float]


def sigma_points(prior: Gaussian, scaling: Scaling = STANDARD) -> list[SigmaPoint]:
    """The 2n+1 points: the centre, then each parameter up, then each down."""
    n = len(prior.names)
    steps = np.sqrt(scaling.spread(n)) * np.linalg.cholesky(prior.covariance).T
    z = np.vstack([prior.mean, prior.mean + steps, prior.mean - steps])
    return [
        SigmaPoint(index, label, z[index], prior.physical(z[index]))
        for index, label in enumerate(sigma_labels(prior.names))
    ]


def sigma_labels(names: Sequence[str]) -> list[str]:
    """Labels in the order of `sigma_points`."""
    return ["centre", *(f"{name}+" for name in names), *(f"{name}-" for name in names)]


@dataclass(frozen=True)
class Moments:
    """Zbar (m,), Cov(X, Z) (n, m), Cov(Z, Z) (m, m), and the labels of the points that are not in them."""

    mean: np.ndarray
    cov_xz: np.ndarray
    cov_zz: np.ndarray
    failed: tuple[str, ...] = ()


def transform(
    points: Sequence[SigmaPoint],
    z: np.ndarray,
    scaling: Scaling = STANDARD,
    completed: np.ndarray | None = None,
) -> Moments:
    """Moments of the observations z (2n+1, m); rows whose `completed` (2n+1,) is False are not looked at.

    The weights of a lost X_(i+) go to what remains as the mirror image Z_(i+) = 2 Z_0 - Z_(i-) says, those of a
    lost centre to the mean of the whole pairs: a linear map keeps its exact moments, and the joint covariance
    stays positive. Raises CalibrationError if a parameter has lost both points, or every pair one and the centre
    too.
    """
    labels = [point.label for point in points]
    x = np.array([point.z for point in points])
    done = np.ones(len(points), dtype=bool) if completed is None else np.asarray(completed, dtype=bool)
    _check_observations(z, done, labels)
    z = _mirrored(z, done, labels)
    mean_weight, weight = scaling.weights(x.shape[1])
    mean = mean_weight @ z
    deviation = z - mean
    return Moments(
        mean,
        (weight[:, None] * (x - x[0])).T @ deviation,
        (weight[:, None] * deviation).T @ deviation,
        tuple(label for label, ok in zip(labels, done, strict=True) if not ok),
    )


def _check_observations(z: np.ndarray, done: np.ndarray, labels: list[str]) -> None:
    if z.ndim != 2 or len(z) != len(labels) or done.shape != (len(labels),):
        raise ValueError(f"unscented: observations {z.shape}, mask {done.shape}; expected {len(labels)} rows")
    bad = [label for label, row, ok in zip(labels, z, done, strict=True) if ok and not np.isfinite(row).all()]
    if bad:
        raise ValueError(
            f"unscented: {', '.join(bad)} observed as not finite; expected numbers, or a mask that says "
            "they failed"
        )


def _mirrored(z: np.ndarray, done: np.ndarray, labels: list[str]) -> np.ndarray:
    """The observations with lost rows filled in; see `transform`."""
    filled, n = z.copy(), len(z) // 2
    up, down = filled[1 : n + 1], filled[n + 1 :]
    has_up, has_down = done[1 : n + 1], done[n + 1 :]
    _require_enough(has_up, has_down, bool(done[0]), labels)
    if not done[0]:
        whole = has_up & has_down
        filled[0] = 0.5 * (up[whole] + down[whole]).mean(axis=0)
    up[~has_up] = 2.0 * filled[0] - down[~has_up]
    down[~has_down] = 2.0 * filled[0] - up[~has_down]
    return filled


def _require_enough(has_up: np.ndarray, has_down: np.ndarray, centre: bool, labels: list[str]) -> None:
    n = len(has_up)
    for i in np.flatnonzero(~(has_up | has_down)):
        raise CalibrationError(
            f"calibration: {labels[i + 1]} and {labels[i + 1 + n]} both failed, so nothing is known of this "
            "parameter: narrow its prior or leave it out of the estimate"
        )
    if not centre and not (has_up & has_down).any():
        raise CalibrationError(
            f"calibration: {labels[0]} and one point of every pair failed: move the prior mean to where the "
            "model runs"
        )
