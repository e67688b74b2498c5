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


class CalibrationError(ValueError):
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
    """Moments of the observations z (2n+1, m); rows whose `completed` (2n+1,) is False are left out.

    Weights are rescaled over what remains such that a linear map keeps its exact moments. A lost X_(i+)
    leaves its mean weight to the centre and its covariance weight to X_(i-); a lost centre leaves its mean
    weight to the pairs. Raises CalibrationError if a parameter has lost both points, or one and the centre.
    """
    labels = [point.label for point in points]
    x = np.array([point.z for point in points])
    done = np.ones(len(points), dtype=bool) if completed is None else np.asarray(completed, dtype=bool)
    _check_observations(z, done, labels)
    mean_weight, weight = _rescale(*scaling.weights(x.shape[1]), done, labels)
    z = np.where(done[:, None], z, 0.0)
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


def _rescale(
    mean: np.ndarray, covariance: np.ndarray, done: np.ndarray, labels: list[str]
) -> tuple[np.ndarray, np.ndarray]:
    """Move the weights of lost points to what remains; see `transform`."""
    mean, covariance = mean.copy(), covariance.copy()
    n = (len(mean) - 1) // 2
    for plus in range(1, n + 1):
        pair = [plus, plus + n]
        alive = [index for index in pair if done[index]]
        if not alive:
            raise CalibrationError(
                f"calibration: {labels[plus]} and {labels[plus + n]} both failed, so nothing is known of "
                "this "
                "parameter: narrow its prior or leave it out of the estimate"
            )
        if len(alive) == 1:
            if not done[0]:
                raise CalibrationError(
                    f"calibration: the centre and one of {labels[plus]}, {labels[plus + n]} failed: move "
                    "the prior "
                    "mean to where the model runs"
                )
            mean[0] += mean[pair].sum()
            mean[pair] = 0.0
            covariance[alive] = covariance[pair].sum()
    if not done[0]:
        mean[1:] += mean[0] / (2 * n)
        mean[0] = 0.0
    covariance[~done] = 0.0
    mean[~done] = 0.0
    return mean, covariance
