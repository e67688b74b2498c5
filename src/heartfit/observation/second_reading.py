r"""Noise of a curve that was read twice, and the mean of both readings.

Two readings of one course, of equal and independent errors with the covariance :math:`s^2 e^{-|t_i - t_j|/\tau}`,
differ by :math:`d` with twice that covariance; their mean has half of it. Hence

.. math:: s_{mean} = \tfrac12 \mathrm{sd}(d), \qquad \tau = -\Delta t / \ln \rho_1

with the correlation :math:`\rho_1` of neighbouring frames of d. What both readings share, as the timing of the frames,
does not show in d.
"""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.observation.curve import Curve

Reading = Literal["mean", "first", "second"]
FITTED_SCALES = 2
"""Parameters of the second reading that were fitted to the first: offset and slope."""


@dataclass(frozen=True)
class FrameNoise:
    """Standard deviation [SI] of the noise of a curve's samples, and its memory [s], zero if it is white."""

    deviation: float
    memory: float

    def covariance(self, times: Floats) -> Floats:
        """Covariance (k, k) of samples at ``times`` (k,) [s]."""
        lags = np.abs(times[:, None] - times)
        correlation = np.exp(-lags / self.memory) if self.memory > 0.0 else np.eye(times.size)
        return self.deviation**2 * correlation


@dataclass(frozen=True, eq=False)
class TwoReadings:
    """Two readings of one curve at the same times; raises InputError for other times or another period."""

    first: Curve
    second: Curve

    def __post_init__(self) -> None:
        same = self.first.times.shape == self.second.times.shape and self.first.period == self.second.period
        if not (same and np.allclose(self.first.times, self.second.times, rtol=0.0, atol=1e-6)):
            raise InputError("second reading: its times differ from the first's; expected the same frames")

    @property
    def mean(self) -> Curve:
        """Mean of both readings."""
        values = 0.5 * (self.first.values + self.second.values)
        return Curve(self.first.times, values, self.first.period)

    def take(self, reading: Reading) -> tuple[Curve, FrameNoise]:
        """Curve and noise of the mean or of one reading, whose noise is larger by the root of two."""
        mean = self.noise()
        alone = replace(mean, deviation=mean.deviation * float(np.sqrt(2.0)))
        return {"mean": (self.mean, mean), "first": (self.first, alone), "second": (self.second, alone)}[
            reading
        ]

    def noise(self) -> FrameNoise:
        """Noise of the mean."""
        difference = self.first.values - self.second.values
        difference = difference - difference.mean()
        square = float(difference @ difference)
        deviation = 0.5 * np.sqrt(square / max(difference.size - FITTED_SCALES, 1))
        correlation = float(difference @ np.roll(difference, 1)) / square if square else 0.0
        step = self.first.period / difference.size
        return FrameNoise(float(deviation), float(-step / np.log(correlation)) if correlation > 0.0 else 0.0)
