"""The 2n+1 points of the unscented transform: the centre and, for each parameter, one up and one down.

Reference: Wan and van der Merwe 2000, doi:10.1109/ASSPCC.2000.882463.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.calibration.design import CalibrationError


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

    def filled(self, z: np.ndarray, done: np.ndarray, labels: Sequence[str]) -> np.ndarray:
        """Lost rows as mirror images, Z_(i+) = 2 Z_0 - Z_(i-), a lost centre as the mean of the whole pairs.

        Raises CalibrationError if a parameter has lost both points, or every pair one and the centre too.
        """
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


def _require_enough(has_up: np.ndarray, has_down: np.ndarray, centre: bool, labels: Sequence[str]) -> None:
    n = len(has_up)
    for i in np.flatnonzero(~(has_up | has_down)).tolist():
        raise CalibrationError(
            f"calibration: {labels[i + 1]} and {labels[i + 1 + n]} both failed, so nothing is known of this "
            "parameter: narrow its prior or leave it out of the estimate"
        )
    if not centre and not (has_up & has_down).any():
        raise CalibrationError(
            f"calibration: {labels[0]} and one point of every pair failed: move the prior mean to where the "
            "model runs"
        )
