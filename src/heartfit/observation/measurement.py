"""Measured observations and their noise, by Monte Carlo through the operator or from a noise model of the protocol."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.operator import CurveFeatures, Reading, require_curves


@dataclass(frozen=True)
class Observation:
    """One measured number: SI value, unit, standard deviation of its noise, and bias (value minus truth)."""

    name: str
    value: float
    unit: str
    noise: float
    bias: float = 0.0


def frame_noise(curve: Curve) -> float:
    """Standard deviation of the noise of the frames, from the upper half of the spectrum of the curve.

    With n samples, harmonics k <= n / 4 count as signal; the rest has n - 1 - 2 k degrees of freedom.
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
    """Observe a measured curve; the noise of each observation is its standard deviation over perturbed curves.

    noise: standard deviation of a frame [SI], estimated from the curve if None; period_uncertainty: relative
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


@dataclass(frozen=True, eq=False)
class Measurement:
    """Observations (m) and the covariance R (m, m) of the truth about their values without bias [SI]."""

    observations: Sequence[Observation]
    covariance: Floats

    @classmethod
    def independent(cls, observations: Sequence[Observation]) -> "Measurement":
        """Combine observations with independent noise: R = diag(noise^2)."""
        return cls(observations, np.diag([observation.noise**2 for observation in observations]))

    def of(self, names: Collection[str]) -> "Measurement":
        """Return the measurement of some observations, in their order here."""
        kept = [place for place, entry in enumerate(self.observations) if entry.name in names]
        return Measurement([self.observations[place] for place in kept], self.covariance[np.ix_(kept, kept)])

    @property
    def values(self) -> dict[str, float]:
        """Measured values by name [SI]."""
        return {observation.name: observation.value for observation in self.observations}

    @property
    def corrected(self) -> dict[str, float]:
        """Measured values without their bias, by name [SI]."""
        return {observation.name: observation.value - observation.bias for observation in self.observations}


def observe_measured(
    curves: Mapping[str, Curve],
    features: Mapping[str, CurveFeatures],
    period_uncertainty: float = 0.05,
    noise_model: NoiseModel | None = None,
) -> Measurement:
    """Observe measured curves, with the covariance of their noise.

    Noise is that of a noise model of the protocol (see `observe_by_model`), or without one the noise that `measure`
    estimates from each curve. period_uncertainty: relative standard deviation of the heart period; breath-holds differ
    in heart rate, the frames of a synthetic sequence do not. Raises InputError for an observation that is not in the
    model.
    """
    if noise_model is not None:
        return observe_by_model(curves, features, noise_model, period_uncertainty)
    require_curves(curves, features)
    observations = [
        observation
        for curve, operator in features.items()
        for observation in measure(operator, curves[curve], period_uncertainty=period_uncertainty)
    ]
    return Measurement.independent(observations)


def observe_by_model(
    curves: Mapping[str, Curve],
    features: Mapping[str, CurveFeatures],
    model: NoiseModel,
    period_uncertainty: float,
) -> Measurement:
    """Observe measured curves, with the bias and covariance of the noise model.

    A relative standard deviation p of the period changes all rates y together, each by -y p:

        R = R_model + p^2 g g^T,   g_i = -y_i for a rate, 0 for a volume or pressure.
    """
    reading = Reading.from_curves(curves, features)
    measured, corrected = reading.observations, model.corrected(reading)
    gradient = period_uncertainty * _per_period(corrected, features)
    covariance = model.covariance(reading) + np.outer(gradient, gradient)
    noise = np.sqrt(np.diag(covariance)).tolist()
    units = [unit for operator in features.values() for unit in operator.units]
    observations = [
        Observation(name, value, unit, sd, value - corrected[name])
        for (name, value), unit, sd in zip(measured.items(), units, noise, strict=True)
    ]
    return Measurement(observations, covariance)


def _per_period(observed: Mapping[str, float], features: Mapping[str, CurveFeatures]) -> Floats:
    """Derivative (m,) of the observations with respect to the logarithm of the period."""
    rates = {name for operator in features.values() for name in operator.rates}
    return np.array([-value if name in rates else 0.0 for name, value in observed.items()])
