"""A measured case as the refits see it: what is fitted, how far to trust it, and what is kept to judge by."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.diagnosis.recording import Recording, Samples
from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import Curve
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.residual import with_noise
from heartfit.proof.noise import covariance
from heartfit.proof.split import Split, Target


@dataclass(frozen=True, eq=False)
class MeasuredCase:
    """Measured curves, without bias, with the noise (k,) of each sample; models: of the images, or none."""

    raw: Mapping[str, Curve]
    curves: Mapping[str, Curve]
    noise: Mapping[str, Floats]
    models: Sequence[NoiseModel]

    @classmethod
    def of(cls, measured: Mapping[str, Curve], models: Sequence[NoiseModel]) -> "MeasuredCase":
        """From measured curves as they are."""
        known = {name: with_noise(name, curve, models) for name, curve in measured.items()}
        curves = {name: curve for name, (curve, _) in known.items()}
        return cls(measured, curves, {name: noise for name, (_, noise) in known.items()}, models)

    @property
    def split(self) -> Split:
        """The samples by whether a fit may see them."""
        return Split.of(self.curves)

    @property
    def target(self) -> Target:
        """What a refit aims at."""
        fitted = self.split.fitted
        return Target(fitted, covariance(fitted, self.raw, self.models))

    def recording(self) -> Recording:
        """All of it, for the search on the sphere."""
        samples = {name: Samples(curve.times, curve.values) for name, curve in self.curves.items()}
        return Recording(self.curves["lv_volume"].period, samples)

    def deviation(self, name: str) -> float:
        """Root mean square noise of a curve's samples, SI."""
        return float(np.sqrt(np.mean(self.noise[name] ** 2)))
