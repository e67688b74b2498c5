r"""A free periodic function of time with a Gaussian prior, and the places that hold one.

.. math:: f(t) = A \Bigl[ s_0 z_0 + \sum_{k=1}^{8} s_k \bigl(z_k \cos \tfrac{2 \pi k t}{T}
          + z_{8+k} \sin \tfrac{2 \pi k t}{T}\bigr) \Bigr], \qquad z \sim N(0, I),
          \quad s_k^2 \propto (2 - \delta_{k0})\, e^{-\frac12 (2 \pi k \ell / T)^2}, \quad \sum_k s_k^2 = 1 .

f is a Gaussian process of standard deviation A whose values are correlated over the length l = 50 ms.
"""

from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.roles import Mechanism, Pressure

HARMONICS = 8
COEFFICIENTS = 2 * HARMONICS + 1
"""Number of the coefficients z."""
LENGTH = 0.05
"""l [s]."""


@dataclass(frozen=True, eq=False, repr=False)
class PeriodicFunction:
    """The Fourier coefficients (COEFFICIENTS,) of a function: constant, cosines, sines, in the unit of its values."""

    coefficients: Floats

    @classmethod
    def from_samples(cls, values: Floats) -> Self:
        """Return the lowest harmonics of ``values`` (n,) at equidistant times from 0 over a period."""
        waves = np.fft.rfft(values)[: HARMONICS + 1] / values.size
        return cls(np.concatenate([waves[:1].real, 2.0 * waves[1:].real, -2.0 * waves[1:].imag]))

    def at(self, time: Floats, period: float) -> Floats:
        """Return the values at ``time`` (any shape) [s]."""
        angle = 2.0 * np.pi / period * np.multiply.outer(np.asarray(time), np.arange(1, HARMONICS + 1))
        waves = np.concatenate([np.cos(angle), np.sin(angle)], axis=-1)
        values: Floats = self.coefficients[0] + waves @ self.coefficients[1:]
        return values

    def __repr__(self) -> str:
        """All digits, which tell two functions apart."""
        return f"PeriodicFunction({self.coefficients.tolist()})"


def prior_deviations(period: float) -> Floats:
    """Return the standard deviations s (COEFFICIENTS,) of the coefficients of a function of unit variance."""
    k = np.arange(HARMONICS + 1)
    variance = np.where(k > 0, 2.0, 1.0) * np.exp(-0.5 * (2.0 * np.pi * k * LENGTH / period) ** 2)
    sd = np.sqrt(variance / variance.sum())
    return np.concatenate([sd, sd[1:]])


@dataclass(frozen=True)
class Place(Mechanism):
    """A mechanism that is a free function of time instead of a law."""

    function: PeriodicFunction
    amplitude: ClassVar[float]
    """A in the unit of the function [SI]."""

    @classmethod
    def from_standardised(cls, z: Floats, period: float) -> Self:
        """Return the place with the function of the coordinates z (COEFFICIENTS,)."""
        return cls(PeriodicFunction(cls.amplitude * prior_deviations(period) * z))

    def standardised(self, period: float) -> Floats:
        """Return the coordinates z (COEFFICIENTS,) of the function."""
        return self.function.coefficients / (self.amplitude * prior_deviations(period))


@dataclass(frozen=True)
class AddedPressure(Place, Pressure):
    """A free function of time [Pa] that is added to the pressure of its compartments."""

    def pressure(self, compartment: str, time: Floats, period: float) -> Floats:  # noqa: ARG002
        return self.function.at(time, period)
