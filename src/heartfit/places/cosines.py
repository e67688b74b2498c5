r"""A free function of a state between two bounds, with a Gaussian prior.

.. math:: f(u) = A \sum_{k=0}^{8} s_k z_k \cos \pi k u, \qquad 0 \le u \le 1, \quad z \sim N(0, I),
          \quad s_k^2 \propto (2 - \delta_{k0})\, e^{-\frac12 (\pi k \ell)^2}, \quad \sum_k s_k^2 = 1 .

f has the standard deviation A on average over u, and its values are correlated over the length l. Beyond the bounds f
keeps its last value.
"""

from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats

COSINES = 9
"""Number of the coefficients z."""


@dataclass(frozen=True, eq=False, repr=False)
class CosineFunction:
    """The coefficients (COSINES,) of a function of u, in the unit of its values."""

    coefficients: Floats

    def at(self, u: Floats) -> Floats:
        """Return the values at ``u`` (any shape)."""
        values: Floats = cosines_at(u) @ self.coefficients
        return values

    def slope_at(self, u: Floats) -> Floats:
        """Return the derivatives by u at ``u`` (any shape), zero beyond the bounds."""
        k = np.arange(COSINES)
        slopes: Floats = -np.pi * np.sin(np.pi * np.multiply.outer(u, k)) @ (k * self.coefficients)
        return np.where((u > 0.0) & (u < 1.0), slopes, 0.0)

    def __repr__(self) -> str:
        """All digits, which tell two functions apart."""
        return f"CosineFunction({self.coefficients.tolist()})"


def cosines_at(u: Floats) -> Floats:
    """Return the cosines (..., COSINES) at ``u`` (...)."""
    return np.asarray(np.cos(np.pi * np.multiply.outer(np.clip(u, 0.0, 1.0), np.arange(COSINES))))


def cosine_deviations(length: float) -> Floats:
    """Return the standard deviations s (COSINES,) of the coefficients, of unit variance and the length l."""
    k = np.arange(COSINES)
    variance = np.where(k > 0, 2.0, 1.0) * np.exp(-0.5 * (np.pi * k * length) ** 2)
    sd: Floats = np.sqrt(variance / np.where(k > 0, 0.5, 1.0).dot(variance))
    return sd
