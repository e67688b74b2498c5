"""Positive parameters as a Gaussian of their logarithms."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np


@dataclass(frozen=True)
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
                "gaussian: the covariance is not positive definite: leave a parameter of no spread out"
            )

    @classmethod
    def of_relative(cls, mean: Mapping[str, float], relative_sd: Mapping[str, float]) -> Self:
        """Independent parameters from their physical median and relative standard deviation, keyed alike."""
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
        """The same belief about these parameters only, in this order; raises ValueError for one it lacks."""
        places = [self.names.index(name) for name in names]
        return type(self)(tuple(names), self.mean[places], self.covariance[np.ix_(places, places)])

    def physical(self, logarithms: np.ndarray | None = None) -> dict[str, float]:
        """Physical parameters by name, exp(z); the median if no z is given."""
        z = self.mean if logarithms is None else logarithms
        return dict(zip(self.names, np.exp(z).tolist(), strict=True))
