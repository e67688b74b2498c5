"""Positive parameters as a Gaussian of their logarithms, and the information that data add to a prior.

In prior standard deviations, y = L^-1 (z - z_0) with C_0 = L L^T, the prior is the unit ball and

    A = I - L^-1 C_post L^-T = sum_i r_i v_i v_i^T,   0 <= r_i <= 1.

r_i is the share of the prior variance along v_i that the data remove. For a linear map A is the resolution matrix: the
mean estimate of a truth y is A y, so that components without information remain at the prior. L A L^-1 is the more
usual I - C_post C_0^-1.
Reference: Backus G, Gilbert F 1968, doi 10.1111/j.1365-246X.1968.tb00216.x.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np
from scipy.linalg import solve_triangular


@dataclass(frozen=True, repr=False)
class Gaussian:
    """z = ln theta ~ N(mean, covariance) over named parameters.

    names (n,); mean (n,); covariance (n, n), both of the logarithms, so that every drawn or estimated
    parameter is positive. A standard deviation of 0.2 in z is about 20 % of theta.
    Raises ValueError if the covariance is not symmetric positive definite.
    """

    names: tuple[str, ...]
    mean: np.ndarray
    covariance: np.ndarray

    def __post_init__(self) -> None:
        object.__setattr__(self, "names", tuple(self.names))
        for name in ("mean", "covariance"):
            object.__setattr__(self, name, np.asarray(getattr(self, name)))
        n = len(self.names)
        if len(set(self.names)) != n or n == 0:
            raise ValueError(f"gaussian: names {self.names}; expected one or more distinct parameters")
        if self.mean.shape != (n,) or self.covariance.shape != (n, n):
            raise ValueError(
                f"gaussian: mean {self.mean.shape}, covariance {self.covariance.shape}; expected ({n},) and "
                f"({n}, {n})"
            )
        if not np.allclose(self.covariance, self.covariance.T, rtol=1e-8, atol=1e-12):
            raise ValueError("gaussian: the covariance is not symmetric")
        if np.linalg.eigvalsh(self.covariance).min() <= 0:
            raise ValueError(
                "gaussian: the covariance is not positive definite: omit parameters without variance"
            )

    def __repr__(self) -> str:
        spreads = zip(self.physical().items(), self.sd, strict=True)
        parts = (f"{name} = {median:.4g} ± {100.0 * sd:.3g} %" for (name, median), sd in spreads)
        return f"Gaussian({', '.join(parts)})"

    @classmethod
    def from_relative(cls, mean: Mapping[str, float], relative_sd: Mapping[str, float]) -> Self:
        """Independent parameters from their physical medians and relative standard deviations, with the same keys."""
        if set(mean) != set(relative_sd):
            raise ValueError(
                f"gaussian: means of {sorted(mean)}, deviations of {sorted(relative_sd)}; expected the same"
            )
        for kind, table in (("mean", mean), ("relative_sd", relative_sd)):
            for name, value in table.items():
                if not (np.isfinite(value) and value > 0):
                    raise ValueError(f"gaussian: {kind} of {name} is {value}; expected a positive number")
        names = tuple(mean)
        logarithms = np.log([mean[name] for name in names])
        return cls(names, logarithms, np.diag(np.square([relative_sd[name] for name in names])))

    @property
    def sd(self) -> np.ndarray:
        """Standard deviations of the logarithms (n,)."""
        return np.sqrt(np.diag(self.covariance))

    def marginal(self, names: Sequence[str]) -> Self:
        """Marginal distribution of these parameters in this order; raises ValueError for an unknown one."""
        places = [self.names.index(name) for name in names]
        return type(self)(tuple(names), self.mean[places], self.covariance[np.ix_(places, places)])

    def physical(self, logarithms: np.ndarray | None = None) -> dict[str, float]:
        """Physical parameters by name, exp(z); the median if no z is given."""
        z = self.mean if logarithms is None else logarithms
        return dict(zip(self.names, np.exp(z).tolist(), strict=True))


INFORMED_SHARE = 0.5
"""Least share of the prior variance that the data remove along an informed direction."""


@dataclass(frozen=True, eq=False)
class Information:
    """Directions of the parameters, from best to least informed.

    names (n,); reduction (n,) r_i, descending; directions (n, n), the columns v_i, of length 1 in prior standard
    deviations; sd_ratio (n,) posterior over prior standard deviation of each parameter.
    """

    names: tuple[str, ...]
    reduction: np.ndarray
    directions: np.ndarray
    sd_ratio: np.ndarray

    @property
    def rank(self) -> int:
        """Number of directions that the data inform."""
        return int((self.reduction > INFORMED_SHARE).sum())

    @property
    def degrees(self) -> float:
        """Effective number of parameters that the data determine, tr A."""
        return float(self.reduction.sum())

    @property
    def resolution(self) -> np.ndarray:
        """Resolution matrix A (n, n)."""
        return (self.directions * self.reduction) @ self.directions.T

    @property
    def informed(self) -> np.ndarray:
        """Orthonormal basis (n, rank) of the informed directions."""
        return self.directions[:, : self.rank]

    @property
    def weakest(self) -> np.ndarray:
        """Least informed direction (n,), with a positive largest component."""
        vector: np.ndarray = self.directions[:, -1]
        return vector * np.sign(vector[np.abs(vector).argmax()])

    def share(self, change: np.ndarray) -> float:
        """Informed share of the square of a change (n,) in prior standard deviations; NaN without a change."""
        square = float(change @ change)
        return float(np.sum((change @ self.informed) ** 2)) / square if square > 0.0 else float("nan")

    def unshrunk(self, change: np.ndarray) -> np.ndarray:
        """Change (n,) without the shrinkage by the prior, A^+ change over the informed directions.

        Components along the other directions are zero.
        """
        basis = self.informed
        return (basis / self.reduction[: self.rank]) @ (basis.T @ change)


def information(prior: Gaussian, posterior: Gaussian) -> Information:
    """Information gained from prior to posterior over the same parameters; raises ValueError if they differ."""
    if prior.names != posterior.names:
        raise ValueError(f"information: {prior.names} before, {posterior.names} after; expected the same")
    factor = np.linalg.cholesky(prior.covariance)
    half = solve_triangular(factor, posterior.covariance, lower=True)
    remaining, directions = np.linalg.eigh(solve_triangular(factor, half.T, lower=True))
    reduction = np.clip(1.0 - remaining, 0.0, 1.0)
    return Information(prior.names, reduction, directions, posterior.sd / prior.sd)
