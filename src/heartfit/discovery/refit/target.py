r"""The data of a refit: fitted samples, their covariance, and held-out samples.

Every other frame of the volumes of both ventricles is fitted, and every other block of 40 ms of the left pressure where
that was recorded. The neighbours of fitted samples are the mildest test; the strain of the wall, which is not fitted at
all, is a harder one.

The covariance of the fitted samples about a correct model is

.. math:: R = R_{measurement} + \rho^2 e^{-|t_i - t_j| / \tau} ,

the first term from a second reading of the curve, else from the noise model of the images, else from the upper half of
the curve's own spectrum; the second the roughness of any model.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.recording import FEWEST_SAMPLES, Recording, Samples
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import frame_noise
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.residual import SIMULATION_ROUGHNESS, unbiased_with_noise
from heartfit.observation.second_reading import FrameNoise, Reading, TwoReadings

BIN, BLOCK = 0.010, 4
"""Length of the bins over which pressure is averaged [s], and number of bins in a block."""

Sampled = Mapping[str, Samples]
"""Samples by the name of their curve."""


@dataclass(frozen=True, eq=False)
class Split:
    """Fitted and held-out samples of one case [SI], at times [s after the trigger]."""

    fitted: Sampled
    held: Sampled

    @classmethod
    def from_curves(cls, curves: Mapping[str, Curve]) -> "Split":
        """Split measured curves without bias: "lv_volume", and optionally "lv_pressure" and "rv_volume"."""
        fitted, held = {}, {}
        fitted["lv_volume"], held["lv_volume"] = _halves(Samples.from_curve(curves["lv_volume"]), 1)
        if "lv_pressure" in curves:
            fitted["lv_pressure"], held["lv_pressure"] = _halves(average_bins(curves["lv_pressure"]), BLOCK)
        if "rv_volume" in curves:
            fitted["rv_volume"], held["rv_volume"] = _halves(Samples.from_curve(curves["rv_volume"]), 1)
        return cls(fitted, held)

    def complete(self) -> Sampled:
        """Both halves of every curve, in the order of time."""
        return {name: samples.merged(self.held[name]) for name, samples in self.fitted.items()}


def average_bins(curve: Curve) -> Samples:
    """Average times and values over equal bins of about 10 ms; an empty bin is left out."""
    count = max(1, round(curve.period / BIN))
    phases = np.mod(curve.times, curve.period)
    places = np.minimum((phases / curve.period * count).astype(int), count - 1)
    number = np.bincount(places, minlength=count)
    full = number > 0
    times, values = (
        np.bincount(places, column, count)[full] / number[full] for column in (phases, curve.values)
    )
    return Samples(times, values)


def _halves(samples: Samples, block: int) -> tuple[Samples, Samples]:
    first = fitted_mask(samples.times.size, block)
    return samples.part(first), samples.part(~first)


def fitted_mask(count: int, block: int = 1) -> np.ndarray:
    """Mask (count,) of the fitted samples: every other block, the first included; a frame is a block of its own."""
    mask: np.ndarray = (np.arange(count) // block) % 2 == 0
    return mask


def sample(curves: Mapping[str, Curve], like: Sampled) -> dict[str, Floats]:
    """The values (k,) of a beat's curves at the times of the samples, by curve."""
    return {name: curves[name](samples.times) for name, samples in like.items()}


def stack(values: Mapping[str, Floats]) -> Floats:
    """Concatenate all curves (n,)."""
    return np.concatenate(list(values.values()))


@dataclass(frozen=True, eq=False)
class Target:
    """Fitted samples (n,) and the covariance (n, n) of a correct model about them."""

    samples: Sampled
    covariance: Floats

    def rows_of(self, part: Sampled) -> np.ndarray:
        """Mask (n,) of the samples of all curves that are in ``part``."""
        times = {name: part[name].times if name in part else np.empty(0) for name in self.samples}
        return np.concatenate([np.isin(samples.times, times[name]) for name, samples in self.samples.items()])

    def values(self) -> Floats:
        """The samples one after the other (n,)."""
        return stack({name: samples.values for name, samples in self.samples.items()})

    def log_likelihood(self, residual: Floats) -> float:
        """-r^T R^-1 r / 2, without the constant, which all models share."""
        return -0.5 * float(residual @ np.linalg.solve(self.covariance, residual))

    def normal(self, residual: Floats, jacobian: Floats) -> tuple[Floats, Floats]:
        """J^T R^-1 r (d,) and J^T R^-1 J (d, d)."""
        weighted = np.linalg.solve(self.covariance, jacobian)
        return weighted.T @ residual, jacobian.T @ weighted

    def misfit(self, predicted: Floats) -> float:
        """r^T R^-1 r."""
        return -2.0 * self.log_likelihood(self.values() - predicted)


ROUGHNESS_MEMORY = 0.05
"""tau of the roughness [s]."""


def covariance(
    fitted: Sampled,
    measured: Mapping[str, Curve],
    models: Sequence[NoiseModel],
    frames: Mapping[str, FrameNoise] | None = None,
) -> Floats:
    """R (n, n), in the order of the samples; measured: their curves; frames: noise of curves that were read twice."""
    known = frames or {}
    blocks = [
        _block(name, samples.times, measured[name], models, known.get(name))
        for name, samples in fitted.items()
    ]
    ends = np.cumsum([0, *(len(block) for block in blocks)])
    total = np.zeros((ends[-1], ends[-1]))
    for start, end, block in zip(ends[:-1], ends[1:], blocks, strict=True):
        total[start:end, start:end] = block
    return total


def _block(
    name: str, times: Floats, curve: Curve, models: Sequence[NoiseModel], read_twice: FrameNoise | None
) -> Floats:
    kind = name.rsplit("_", 1)[1]
    lags = np.abs(times[:, None] - times)
    rough: Floats = SIMULATION_ROUGHNESS[kind] ** 2 * np.exp(
        -np.minimum(lags, curve.period - lags) / ROUGHNESS_MEMORY
    )
    if read_twice is not None:
        return rough + read_twice.covariance(times)
    for model in models if kind == "volume" else ():
        phases = np.rint(times / curve.period * model.phases).astype(int)
        return rough + model.curve_covariance(curve, name)[np.ix_(phases, phases)]
    return rough + frame_noise(curve) ** 2 * np.eye(times.size)


@dataclass(frozen=True, eq=False)
class MeasuredCase:
    """Measured curves as they are (``raw``) and without bias, noise (k,) of their samples, and noise models, if any.

    frames: noise of curves that were read twice.
    """

    raw: Mapping[str, Curve]
    curves: Mapping[str, Curve]
    noise: Mapping[str, Floats]
    models: Sequence[NoiseModel]
    frames: Mapping[str, FrameNoise] = field(default_factory=dict)

    @classmethod
    def from_curves(
        cls,
        measured: Mapping[str, Curve],
        models: Sequence[NoiseModel],
        second: Curve | None = None,
        reading: Reading = "mean",
    ) -> "MeasuredCase":
        """Remove the bias of measured curves.

        second: another reading of the left volume; reading: whether their mean or one of them is the volume. The
        fitted frames alone give the second reading its scale, and the noise.
        """
        corrected = {name: unbiased_with_noise(name, curve, models) for name, curve in measured.items()}
        curves = {name: curve for name, (curve, _) in corrected.items()}
        noise = {name: sd for name, (_, sd) in corrected.items()}
        frames: dict[str, FrameNoise] = {}
        if second is not None:
            readings = TwoReadings(curves["lv_volume"], second, fitted_mask(second.times.size))
            curves["lv_volume"], frames["lv_volume"] = readings.take(reading)
            scatter = np.hypot(frames["lv_volume"].deviation, SIMULATION_ROUGHNESS["volume"])
            noise["lv_volume"] = np.full(second.times.size, scatter)
        return cls(measured, curves, noise, models, frames)

    @property
    def both(self) -> bool:
        """True where the volumes of both ventricles were measured."""
        return "rv_volume" in self.curves

    @property
    def split(self) -> Split:
        """Fitted and held-out samples."""
        return Split.from_curves(self.curves)

    @property
    def target(self) -> Target:
        """The target of a refit."""
        return self._target(self.split.fitted)

    @property
    def complete_target(self) -> Target:
        """The fitted samples and their other half, from which the size of a kept mechanism is estimated."""
        return self._target(self.split.complete())

    def _target(self, samples: Sampled) -> Target:
        return Target(samples, self.covariance(samples))

    def covariance(self, samples: Sampled) -> Floats:
        """Covariance (n, n) of a correct model about the samples, in their order."""
        return covariance(samples, self.raw, self.models, self.frames)

    def recording(self) -> Recording:
        """All curves as the recording for the search on the sphere."""
        return self._recording({name: Samples.from_curve(curve) for name, curve in self.curves.items()})

    def halves(self) -> tuple[Recording, Recording | None]:
        """The fitted half, which chooses a name, and the other one, which judges it.

        Both hold the curves of the left ventricle; the first also has the right volume, which is not searched. Too few
        frames for two halves are kept together, without a second one.
        """
        split = self.split
        if min(samples.times.size for samples in split.held.values()) < FEWEST_SAMPLES:
            return self.recording(), None
        whole = self.recording().curves
        kept = [name for name in split.fitted if name != "rv_volume"]
        fitted, held = ({name: half[name] for name in kept} for half in (split.fitted, split.held))
        right = {name: samples for name, samples in whole.items() if name not in kept}
        return self._recording(fitted | right), self._recording(held)

    def _recording(self, samples: Sampled) -> Recording:
        return Recording(self.curves["lv_volume"].period, samples, self.frames)

    def deviation(self, name: str) -> float:
        """Root mean square noise of a curve's samples [SI]."""
        return float(np.sqrt(np.mean(self.noise[name] ** 2)))
