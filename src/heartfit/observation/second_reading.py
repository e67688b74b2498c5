r"""Noise of a curve that was read twice, and the mean of both readings.

Two readings of one course, of equal and independent errors with the covariance :math:`s^2 e^{-|t_i - t_j|/\tau}`,
differ by :math:`d` with twice that covariance; their mean has half of it. Hence

.. math:: s_{mean} = \tfrac12 \mathrm{sd}(d), \qquad \tau = -\Delta t / \ln \rho_1

with the correlation :math:`\rho_1` of neighbouring frames of d. Scale and noise come from the frames that choose a
model alone: those that judge it tell nothing before.

The readings are not independent. What they share, as the timing of the frames and the length of the cavity, does not
show in d: :math:`s_{mean}` is a lower bound. The second reading is V = a + b L A with the areas A of the blood, so an
error of the length L moves the first by :math:`V \delta L / L` and the second by :math:`b A \delta L`, in one
direction.
"""

from dataclasses import dataclass, replace
from functools import cached_property
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
    """Two readings of one curve at the same times; raises InputError for other times or another period.

    chosen (k,): mask of the frames that give the scale of the second reading, and the noise.
    """

    first: Curve
    second: Curve
    chosen: np.ndarray

    def __post_init__(self) -> None:
        same = self.first.times.shape == self.second.times.shape and self.first.period == self.second.period
        if not (same and np.allclose(self.first.times, self.second.times, rtol=0.0, atol=1e-6)):
            raise InputError("second reading: its times differ from the first's; expected the same frames")

    @cached_property
    def scaled(self) -> Curve:
        """The second reading at the offset and scale of the first."""
        design = np.column_stack([np.ones_like(self.second.values), self.second.values])
        scales = np.linalg.lstsq(design[self.chosen], self.first.values[self.chosen], rcond=None)[0]
        return replace(self.second, values=design @ scales)

    @property
    def mean(self) -> Curve:
        """Mean of both readings."""
        values = 0.5 * (self.first.values + self.scaled.values)
        return Curve(self.first.times, values, self.first.period)

    def take(self, reading: Reading) -> tuple[Curve, FrameNoise]:
        """Curve and noise of the mean or of one reading, whose noise is larger by the root of two."""
        mean = self.noise()
        alone = replace(mean, deviation=mean.deviation * float(np.sqrt(2.0)))
        return {"mean": (self.mean, mean), "first": (self.first, alone), "second": (self.scaled, alone)}[
            reading
        ]

    def noise(self) -> FrameNoise:
        """Noise of the mean, from the chosen frames."""
        difference = (self.first.values - self.scaled.values)[self.chosen]
        square = float(difference @ difference)
        deviation = 0.5 * np.sqrt(square / max(difference.size - FITTED_SCALES, 1))
        correlation = float(difference @ np.roll(difference, 1)) / square if square else 0.0
        step = self.first.period / difference.size
        return FrameNoise(float(deviation), float(-step / np.log(correlation)) if correlation > 0.0 else 0.0)
