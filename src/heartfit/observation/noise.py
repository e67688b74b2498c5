"""Measured observations with their noise, by Monte-Carlo through the same operator."""

from dataclasses import dataclass, replace

import numpy as np

from heartfit.observation.curve import Curve
from heartfit.observation.operator import CurveFeatures


@dataclass(frozen=True)
class Observation:
    """One measured number: SI value, its unit, the standard deviation of its noise and the bias, value less truth."""

    name: str
    value: float
    unit: str
    noise: float
    bias: float = 0.0


def frame_noise(curve: Curve) -> float:
    """Standard deviation of the frames' noise, from the upper half of the curve's own spectrum.

    Of n samples, harmonics k <= n / 4 are taken as heart; what is left has n - 1 - 2 k degrees of freedom.
    An upper bound: the corners of a noiseless beat lie in the upper harmonics as well.
    """
    count = curve.values.size
    kept = count // 4
    spectrum = np.fft.rfft(curve.values)
    spectrum[: kept + 1] = 0.0
    rest = np.fft.irfft(spectrum, count)
    return float(np.sqrt(np.sum(rest**2) / (count - 1 - 2 * kept)))


def measure(
    features: CurveFeatures,
    curve: Curve,
    noise: float | None = None,
    period_uncertainty: float = 0.05,
    draws: int = 1000,
    seed: int = 0,
) -> list[Observation]:
    """Observations of a measured curve, each with the noise the measurement's own scatter gives it.

    noise: standard deviation of a frame (SI; estimated from the curve if None); period_uncertainty: relative
    standard deviation of the heart period, which scales every rate (breath-holds differ in heart rate).
    """
    random = np.random.default_rng(seed)
    scatter = frame_noise(curve) if noise is None else noise
    drawn = [features(_perturb(curve, scatter, period_uncertainty, random)) for _ in range(draws)]
    return [
        Observation(name, value, unit, float(np.std([draw[name] for draw in drawn])))
        for (name, value), unit in zip(features(curve).items(), features.units, strict=True)
    ]


def _perturb(curve: Curve, scatter: float, period_uncertainty: float, random: np.random.Generator) -> Curve:
    stretch = np.exp(period_uncertainty * random.standard_normal())
    values = curve.values + scatter * random.standard_normal(curve.values.size)
    return replace(curve, times=curve.times * stretch, values=values, period=curve.period * stretch)
