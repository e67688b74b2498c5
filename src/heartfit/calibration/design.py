r"""Designs of the unscented transform: 2n+1 points, spherical simplex, and replacement of failed points.

**2n+1 points.** The centre and two points for each parameter, one above and one below.

Reference: Wan and van der Merwe 2000, doi:10.1109/ASSPCC.2000.882463.

**Spherical simplex, n+2 points.** The centre and the n+1 corners of a regular simplex, with equal weights. The corners
for n parameters are those for n-1 at a common negative coordinate, and one more corner at a positive one,

.. math:: X^{(n)} = \begin{pmatrix} X^{(n-1)} & 0 \\ -h_n & n\, h_n \end{pmatrix}, \quad
          h_n = \frac{1}{\sqrt{n (n + 1) w}}, \quad w = \frac{1 - W_0}{n + 1} .

Mean and covariance are as exact as those of the 2n+1 points, with nearly half the simulations. The third moments are
not zero, so that curvature of the model contributes to Cov(X, Z).

Reference: Julier 2003, doi:10.1109/ACC.2003.1243439.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from heartfit.core.errors import InputError


class CalibrationError(InputError):
    """The remaining sigma points do not determine the moments; the message names the failed ones."""


class Design(Protocol):
    """A set of p points for n parameters, the centre first."""

    def labels(self, names: Sequence[str]) -> list[str]:
        """Names (p,) of the points."""

    def offsets(self, n: int) -> np.ndarray:
        """Points (p, n) of a standard Gaussian: mean 0, covariance 1 under the weights."""

    def weights(self, n: int) -> tuple[np.ndarray, np.ndarray]:
        """W^m and W^c, (p,) each."""

    def filled(self, z: np.ndarray, completed: np.ndarray, labels: Sequence[str]) -> np.ndarray:
        """Observations (p, m) with the rows of failed points, ``completed`` (p,) False, replaced as for an affine map.

        Raises CalibrationError, which names the points, if the others do not determine these rows.
        """


@dataclass(frozen=True)
class Scaling:
    """The three free numbers of the 2n+1 points.

    a = 1 and kappa = 0 place the points at gamma = sqrt(n) with W_0^m = 0: far enough that the noise of q_min and dP/dt
    is not amplified by 1/a^2, and near enough that every simulation is admissible. kappa = 3 - n would make W_0
    negative for n > 3. b = 2 is the value for a Gaussian prior.
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
        """W^m and W^c, (2n+1,) each, in the order of the labels."""
        spread = self.spread(n)
        mean = np.full(2 * n + 1, 0.5 / spread)
        mean[0] = 1 - n / spread
        covariance = mean.copy()
        covariance[0] += 1 - self.a**2 + self.b
        return mean, covariance

    def offsets(self, n: int) -> np.ndarray:
        """The centre, then +- gamma along each axis (2n+1, n)."""
        steps = np.sqrt(self.spread(n)) * np.eye(n)
        return np.vstack([np.zeros(n), steps, -steps])

    def labels(self, names: Sequence[str]) -> list[str]:
        """ "centre", then each parameter up, then each down."""
        return ["centre", *(f"{name}+" for name in names), *(f"{name}-" for name in names)]

    def filled(self, z: np.ndarray, completed: np.ndarray, labels: Sequence[str]) -> np.ndarray:
        """Replace failed rows by mirror images, Z_(i+) = 2 Z_0 - Z_(i-), a failed centre by the mean of complete pairs.

        Raises CalibrationError if both points of a parameter failed, or the centre and one point of every pair.
        """
        filled, n = z.copy(), len(z) // 2
        up, down = filled[1 : n + 1], filled[n + 1 :]
        has_up, has_down = completed[1 : n + 1], completed[n + 1 :]
        _require_enough(has_up, has_down, bool(completed[0]), labels)
        if not completed[0]:
            whole = has_up & has_down
            filled[0] = 0.5 * (up[whole] + down[whole]).mean(axis=0)
        up[~has_up] = 2.0 * filled[0] - down[~has_up]
        down[~has_down] = 2.0 * filled[0] - up[~has_down]
        return filled


def _require_enough(has_up: np.ndarray, has_down: np.ndarray, centre: bool, labels: Sequence[str]) -> None:
    n = len(has_up)
    for i in np.flatnonzero(~(has_up | has_down)).tolist():
        raise CalibrationError(
            f"calibration: {labels[i + 1]} and {labels[i + 1 + n]} both failed, so the effect of this "
            "parameter is unknown: narrow its prior or do not estimate it"
        )
    if not centre and not (has_up & has_down).any():
        raise CalibrationError(
            f"calibration: {labels[0]} and one point of every pair failed: move the prior mean to where the "
            "model runs"
        )


@dataclass(frozen=True)
class Simplex:
    """The spherical simplex.

    centre: weight W_0 of the centre in the mean, 0 <= W_0 < 1; b is added to it in the covariance, as in `Scaling`.
    All corners have the distance sqrt(n / (1 - W_0)) from the centre; for W_0 = 0 that of the standard 2n+1 points.
    """

    centre: float = 0.0
    b: float = 2.0

    def __post_init__(self) -> None:
        if not 0.0 <= self.centre < 1.0:
            raise ValueError(f"simplex: centre={self.centre}; expected a weight of 0 or more, below 1")

    def weights(self, n: int) -> tuple[np.ndarray, np.ndarray]:
        """W^m and W^c, (n+2,) each."""
        mean = np.full(n + 2, (1.0 - self.centre) / (n + 1))
        mean[0] = self.centre
        covariance = mean.copy()
        covariance[0] += self.b
        return mean, covariance

    def offsets(self, n: int) -> np.ndarray:
        """The centre, then the corners (n+2, n)."""
        corners = np.zeros((n + 1, n))
        weight = self.weights(n)[0][1]
        for j in range(n):
            height = 1.0 / np.sqrt((j + 1) * (j + 2) * weight)
            corners[: j + 1, j] = -height
            corners[j + 1, j] = (j + 1) * height
        return np.vstack([np.zeros(n), corners])

    def labels(self, names: Sequence[str]) -> list[str]:
        """ "centre", then the corners by number."""
        return ["centre", *(f"corner {index}" for index in range(len(names) + 1))]

    def filled(self, z: np.ndarray, completed: np.ndarray, labels: Sequence[str]) -> np.ndarray:
        """Replace a failed point, given that the corners sum to n+1 times the centre.

        Raises CalibrationError if two points failed: n points do not determine slopes in n directions.
        """
        if (~completed).sum() > 1:
            lost = ", ".join(label for label, ok in zip(labels, completed, strict=True) if not ok)
            raise CalibrationError(
                f"calibration: {lost} failed; a simplex allows one failed point: narrow the prior or use 2n+1 points"
            )
        filled, corners = z.copy(), len(z) - 1
        if not completed[0]:
            filled[0] = z[1:].mean(axis=0)
        for index in (np.flatnonzero(~completed[1:]) + 1).tolist():
            filled[index] = corners * z[0] - np.delete(z[1:], index - 1, axis=0).sum(axis=0)
        return filled
