"""Everything that was observed of one heart, and how far to trust it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import Curve
from heartfit.observation.noise import Observation, measure
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.operator import CurveFeatures
from heartfit.observation.pair import Reading
from heartfit.observation.vector import require_curves


@dataclass(frozen=True, eq=False)
class Measurement:
    """The observations (m) and the covariance R (m, m) of the truth about their values without bias, SI."""

    observations: Sequence[Observation]
    covariance: Floats

    @classmethod
    def independent(cls, observations: Sequence[Observation]) -> "Measurement":
        """Observations whose noises know nothing of each other: R = diag(noise^2)."""
        return cls(observations, np.diag([each.noise**2 for each in observations]))

    @property
    def values(self) -> dict[str, float]:
        """What was measured, by name."""
        return {each.name: each.value for each in self.observations}

    @property
    def corrected(self) -> dict[str, float]:
        """The same without the bias."""
        return {each.name: each.value - each.bias for each in self.observations}


def observe_measured(
    curves: Mapping[str, Curve],
    features: Mapping[str, CurveFeatures],
    period_uncertainty: float = 0.05,
    noise_model: NoiseModel | None = None,
) -> Measurement:
    """The observations of measured curves, and how far to trust them.

    By a noise model of the protocol where there is one (see `observe_by_model`), else by the noise that
    `heartfit.observation.noise.measure` finds for each number in the curve itself. period_uncertainty: relative
    standard deviation of the heart period: breath-holds differ in heart rate, a synthetic sequence has one.
    Raises InputError for an observation that the model does not know.
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
    """The observations with the bias and covariance that the model knows of its protocol.

    With the relative standard deviation p of the period every rate y goes with -y p, all of them together:

        R = R_model + p^2 g g^T,   g_i = -y_i for a rate, 0 for a volume or pressure.
    """
    reading = Reading.of(curves, features)
    measured, corrected = reading.observations, model.corrected(reading)
    stretched = period_uncertainty * _per_period(corrected, features)
    covariance = model.covariance(reading) + np.outer(stretched, stretched)
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
