"""What is fitted of a measured case, and what is kept to judge by.

Every other frame of the left ventricle's volume is fitted, and every other block of 40 ms of its pressure where that
was recorded. Neighbours of what is fitted are the mildest of judges; the right ventricle's volume, which is not fitted
at all, is a harder one.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.diagnosis.recording import Samples
from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import Curve

BIN, BLOCK = 0.010, 4
"""s of pressure that are averaged, and bins that stay together."""

Sampled = Mapping[str, Samples]
"""Samples by the name of their curve."""


@dataclass(frozen=True, eq=False)
class Split:
    """Samples of one case, SI at s after the trigger, by whether a fit may see them."""

    fitted: Sampled
    held: Sampled

    @classmethod
    def of(cls, curves: Mapping[str, Curve]) -> "Split":
        """From measured curves, without bias; "lv_volume" is there, "lv_pressure" and "rv_volume" may be."""
        fitted, held = {}, {}
        frames = Samples(curves["lv_volume"].times, curves["lv_volume"].values)
        fitted["lv_volume"], held["lv_volume"] = _halves(frames, 1)
        if "lv_pressure" in curves:
            fitted["lv_pressure"], held["lv_pressure"] = _halves(binned(curves["lv_pressure"]), BLOCK)
        if "rv_volume" in curves:
            held["rv_volume"] = Samples(curves["rv_volume"].times, curves["rv_volume"].values)
        return cls(fitted, held)


def binned(curve: Curve) -> Samples:
    """Means of times and values over equal bins of about 10 ms; a bin without sample is left out."""
    count = max(1, round(curve.period / BIN))
    phases = np.mod(curve.times, curve.period)
    places = np.minimum((phases / curve.period * count).astype(int), count - 1)
    number = np.bincount(places, minlength=count)
    full = number > 0
    times, values = (np.bincount(places, each, count)[full] / number[full] for each in (phases, curve.values))
    return Samples(times, values)


def _halves(samples: Samples, block: int) -> tuple[Samples, Samples]:
    first = (np.arange(samples.times.size) // block) % 2 == 0
    return samples.part(first), samples.part(~first)


def sampled(curves: Mapping[str, Curve], like: Sampled) -> dict[str, Floats]:
    """The values (k,) of a beat's curves at the times of the samples, by curve."""
    return {name: curves[name](samples.times) for name, samples in like.items()}


def stacked(values: Mapping[str, Floats]) -> Floats:
    """All curves one after the other (n,)."""
    return np.concatenate(list(values.values()))


@dataclass(frozen=True, eq=False)
class Target:
    """What is fitted: samples (n,) and the covariance (n, n) of a right model about them."""

    samples: Sampled
    covariance: Floats

    def values(self) -> Floats:
        """The samples one after the other (n,)."""
        return stacked({name: samples.values for name, samples in self.samples.items()})

    def misfit(self, predicted: Floats) -> float:
        """r^T R^-1 r."""
        residual = self.values() - predicted
        return float(residual @ np.linalg.solve(self.covariance, residual))
