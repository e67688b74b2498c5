r"""A free periodic function of time with a Gaussian prior.

.. math:: f(t) = A \Bigl[ s_0 z_0 + \sum_{k=1}^{8} s_k \bigl(z_k \cos \tfrac{2 \pi k t}{T}
          + z_{8+k} \sin \tfrac{2 \pi k t}{T}\bigr) \Bigr], \qquad z \sim N(0, I),
          \quad s_k^2 \propto (2 - \delta_{k0})\, e^{-\frac12 (2 \pi k \ell / T)^2}, \quad \sum_k s_k^2 = 1 .

f is a Gaussian process of standard deviation A whose values are correlated over the length l.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from heartfit.core.arrays import Floats

HARMONICS = 8
COEFFICIENTS = 2 * HARMONICS + 1
"""Number of the coefficients z."""


@dataclass(frozen=True, eq=False, repr=False)
class PeriodicFunction:
    """The Fourier coefficients (COEFFICIENTS,) of a function: constant, cosines, sines, in the unit of its values.

    period: T [s].
    """

    coefficients: Floats
    period: float

    @classmethod
    def from_samples(cls, values: Floats, period: float) -> Self:
        """Return the lowest harmonics of ``values`` (n,) at equidistant times from 0 over a period [s]."""
        waves = np.fft.rfft(values)[: HARMONICS + 1] / values.size
        return cls(np.concatenate([waves[:1].real, 2.0 * waves[1:].real, -2.0 * waves[1:].imag]), period)

    def at(self, time: Floats) -> Floats:
        """Return the values at ``time`` (any shape) [s]."""
        values: Floats = waves_at(time, self.period) @ self.coefficients
        return values

    def integral(self, time: Floats) -> Floats:
        """Return the integrals over [0, ``time``], a time of any shape [s]."""
        rate = 2.0 * np.pi / self.period * np.arange(1, HARMONICS + 1)
        angle = np.multiply.outer(np.asarray(time), rate)
        constant, cosines, sines = np.split(self.coefficients, [1, HARMONICS + 1])
        waves = (np.sin(angle) / rate) @ cosines + ((1.0 - np.cos(angle)) / rate) @ sines
        total: Floats = constant[0] * np.asarray(time) + waves
        return total

    def __repr__(self) -> str:
        """All digits, which tell two functions apart."""
        return f"PeriodicFunction({self.coefficients.tolist()}, {self.period!r})"


def waves_at(time: Floats, period: float) -> Floats:
    """Return the constant, the cosines and the sines (..., COEFFICIENTS) at ``time`` (...) [s]."""
    angle = 2.0 * np.pi / period * np.multiply.outer(np.asarray(time), np.arange(1, HARMONICS + 1))
    return np.concatenate([np.ones((*np.shape(time), 1)), np.cos(angle), np.sin(angle)], axis=-1)


def wave_deviations(period: float, length: float) -> Floats:
    """Return the standard deviations s (COEFFICIENTS,) of the coefficients, of unit variance and the length l [s]."""
    k = np.arange(HARMONICS + 1)
    variance = np.where(k > 0, 2.0, 1.0) * np.exp(-0.5 * (2.0 * np.pi * k * length / period) ** 2)
    sd = np.sqrt(variance / variance.sum())
    return np.concatenate([sd, sd[1:]])
