r"""The n+2 points of the spherical simplex: a centre and the corners of a regular simplex, n+1 equal weights.

The corners of n parameters are those of n-1 with a common height below, and one corner more above,

.. math:: X^{(n)} = \begin{pmatrix} X^{(n-1)} & 0 \\ -h_n & n\, h_n \end{pmatrix}, \quad
          h_n = \frac{1}{\sqrt{n (n + 1) w}}, \quad w = \frac{1 - W_0}{n + 1} .

Mean and covariance are exact as those of the 2n+1 points are. The third moments are not zero: curvature of the model
leaks into Cov(X, Z), which is the price of nearly half the simulations.

Reference: Julier 2003, doi:10.1109/ACC.2003.1243439.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.calibration.design import CalibrationError


@dataclass(frozen=True)
class Simplex:
    """centre: weight W_0 of the centre in the mean, 0 <= W_0 < 1; b is added in the covariance, as `Scaling` does.

    All corners lie sqrt(n / (1 - W_0)) from the centre: with W_0 = 0 as far as the standard 2n+1 points.
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

    def filled(self, z: np.ndarray, done: np.ndarray, labels: Sequence[str]) -> np.ndarray:
        """A lost corner as the centre and the others have it: the corners sum to n+1 times the centre.

        Raises CalibrationError if two are lost, since n points say no slope in n directions.
        """
        if (~done).sum() > 1:
            lost = ", ".join(label for label, ok in zip(labels, done, strict=True) if not ok)
            raise CalibrationError(
                f"calibration: {lost} failed, and a simplex can lose one point: narrow the prior or use 2n+1 points"
            )
        filled, corners = z.copy(), len(z) - 1
        if not done[0]:
            filled[0] = z[1:].mean(axis=0)
        for index in (np.flatnonzero(~done[1:]) + 1).tolist():
            filled[index] = corners * z[0] - np.delete(z[1:], index - 1, axis=0).sum(axis=0)
        return filled
