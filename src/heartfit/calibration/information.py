"""What the data say of the parameters, and what only the prior does.

In prior standard deviations, y = L^-1 (z - z_0) with C_0 = L L^T, the prior is the unit ball and

    A = I - L^-1 C_post L^-T = sum_i r_i v_i v_i^T,   0 <= r_i <= 1.

r_i is the share of the prior's variance that the data took away along v_i. On a linear map A is the resolution: of a
truth y the estimate shows A y on average, so that what is not seen comes back as the prior. L A L^-1 is the more usual
I - C_post C_0^-1.
Reference: Backus G, Gilbert F 1968, doi 10.1111/j.1365-246X.1968.tb00216.x.
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular

from heartfit.calibration.gaussian import Gaussian

SEEN = 0.5
"""Share of the prior's variance that the data must take away before a direction counts as informed."""


@dataclass(frozen=True, eq=False)
class Information:
    """Directions of the parameters from best to least seen.

    names (n,); reduction (n,) r_i, descending; directions (n, n), the columns v_i, of length 1 in prior standard
    deviations; sd_ratio (n,) posterior over prior standard deviation of each parameter.
    """

    names: tuple[str, ...]
    reduction: np.ndarray
    directions: np.ndarray
    sd_ratio: np.ndarray

    @property
    def rank(self) -> int:
        """How many directions the data inform."""
        return int((self.reduction > SEEN).sum())

    @property
    def degrees(self) -> float:
        """tr A: the number of parameters' worth that the data say."""
        return float(self.reduction.sum())

    @property
    def resolution(self) -> np.ndarray:
        """A (n, n)."""
        return (self.directions * self.reduction) @ self.directions.T

    @property
    def informed(self) -> np.ndarray:
        """Orthonormal basis (n, rank) of what the data inform."""
        return self.directions[:, : self.rank]

    @property
    def weakest(self) -> np.ndarray:
        """The direction (n,) of which the data say least, its largest component positive."""
        vector: np.ndarray = self.directions[:, -1]
        return vector * np.sign(vector[np.abs(vector).argmax()])

    def share(self, change: np.ndarray) -> float:
        """How much of the square of a change (n,), in prior standard deviations, is informed; NaN of none."""
        square = float(change @ change)
        return float(np.sum((change @ self.informed) ** 2)) / square if square > 0.0 else float("nan")

    def unshrunk(self, change: np.ndarray) -> np.ndarray:
        """The change (n,) that the data ask for, A^+ over the informed directions: free of the pull of the prior.

        What the data do not inform is left out, not guessed.
        """
        basis = self.informed
        return (basis / self.reduction[: self.rank]) @ (basis.T @ change)


def information(prior: Gaussian, posterior: Gaussian) -> Information:
    """What was learnt between two Gaussians of the same parameters; raises ValueError if they are not."""
    if prior.names != posterior.names:
        raise ValueError(f"information: {prior.names} before, {posterior.names} after; expected the same")
    factor = np.linalg.cholesky(prior.covariance)
    half = solve_triangular(factor, posterior.covariance, lower=True)
    remaining, directions = np.linalg.eigh(solve_triangular(factor, half.T, lower=True))
    reduction = np.clip(1.0 - remaining, 0.0, 1.0)
    return Information(prior.names, reduction, directions, posterior.sd / prior.sd)
