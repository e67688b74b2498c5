r"""What is measured of a hidden heart: frames of volume and a catheter's pressure, with errors nobody is told of.

.. math:: V'_i = V(t_i) + r_V(t_i) + \epsilon_i, \quad \epsilon_i = a\,\epsilon_{i-1} + \sqrt{1 - a^2}\, s\, z_i, \qquad
          P'_j = \overline{P} + r_P(t_j) + \overline{\epsilon},

the bar being the mean over 10 ms of samples at 1 kHz. r is smooth, periodic and Gaussian: what any model leaves over.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.beat import Beat
from heartfit.geometry.arrays import Floats
from heartfit.mechanism import Sensor
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve

FRAMES = (25, 30)
VOLUME_NOISE = (0.01, 0.03)
"""Standard deviation over the end-diastolic volume, from and to."""
MEMORY = 0.6
"""Correlation of the error of a frame with that of the one before."""
PRESSURE_NOISE, RATE, AVERAGED = 300.0, 1000.0, 10
"""Pa of each sample; samples a second; samples that are averaged."""
VOLUME_ROUGHNESS, PRESSURE_ROUGHNESS, ROUGHNESS_LENGTH = 0.6e-6, 150.0, 0.05
"""Standard deviations, m^3 and Pa, and correlation time, s, of what no model explains."""


@dataclass(frozen=True)
class Study:
    """How a heart is measured: number of frames and noise of the volume over the end-diastolic volume."""

    frames: int
    noise: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> "Study":
        low, high = FRAMES
        return cls(int(rng.integers(low, high + 1)), float(rng.uniform(*VOLUME_NOISE)))


def measured(
    beat: Beat, sensors: tuple[Sensor, ...], study: Study, rng: np.random.Generator
) -> dict[str, Curve]:
    """Volume and pressure of the left ventricle, time zero at the trigger."""
    true: Mapping[str, Curve] = beat_curves(beat, sensors)
    return {
        "lv_volume": _volume(true["lv_volume"], study, rng),
        "lv_pressure": recorded_pressure(true["lv_pressure"], rng),
    }


def _volume(true: Curve, study: Study, rng: np.random.Generator) -> Curve:
    frames = true.resampled(study.frames)
    error = study.noise * float(true.values.max()) * autoregressive(study.frames, MEMORY, rng)
    rough = VOLUME_ROUGHNESS * smooth(frames.times, true.period, ROUGHNESS_LENGTH, rng)
    return Curve(frames.times, frames.values + rough + error, true.period)


def recorded_pressure(true: Curve, rng: np.random.Generator) -> Curve:
    """A catheter's record of a true pressure."""
    count = int(true.period * RATE) // AVERAGED
    times = np.arange(count * AVERAGED) / RATE
    samples = true(times) + PRESSURE_NOISE * rng.standard_normal(len(times))
    middles, means = (each.reshape(count, AVERAGED).mean(axis=1) for each in (times, samples))
    rough = PRESSURE_ROUGHNESS * smooth(middles, true.period, ROUGHNESS_LENGTH, rng)
    return Curve(middles, means + rough, true.period)


def autoregressive(count: int, memory: float, rng: np.random.Generator) -> Floats:
    """A stationary sequence (count,) of variance 1 whose neighbours correlate with ``memory``."""
    error = rng.standard_normal(count)
    for i in range(1, count):
        error[i] = memory * error[i - 1] + np.sqrt(1.0 - memory**2) * error[i]
    return error


def smooth(times: Floats, period: float, length: float, rng: np.random.Generator) -> Floats:
    r"""A periodic Gaussian process at ``times`` (t,), of variance 1 and nearly squared-exponential correlation.

    .. math:: r(t) = \sum_k \sqrt{w_k}\, (a_k \cos \omega_k t + b_k \sin \omega_k t), \qquad
              w_k \propto e^{-(\omega_k \ell)^2 / 2}, \quad \omega_k = 2 \pi k / T
    """
    k = np.arange(1, 1 + int(np.ceil(period / length)))
    omega = 2.0 * np.pi * k / period
    weight = np.exp(-0.5 * (omega * length) ** 2)
    a, b = np.sqrt(weight / weight.sum()) * rng.standard_normal((2, len(k)))
    angle = omega * times[:, None]
    return np.cos(angle) @ a + np.sin(angle) @ b
