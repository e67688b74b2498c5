"""Samples of a curve, and their average over beats."""

from dataclasses import dataclass
from typing import Self

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.observation.curve import Curve

BIN = 0.010
"""Length of the bins over which pressure is averaged [s]."""
ROUNDING = 1e-6
"""Rounding of times, over the bin: a sample on the edge belongs to the later bin."""


@dataclass(frozen=True, eq=False)
class Samples:
    """Values (k,) [SI] at increasing times (k,) [s after a trigger]; times beyond the period belong to later beats.

    Raises InputError unless shapes agree, times increase and all numbers are finite.
    """

    times: Floats
    values: Floats

    def __post_init__(self) -> None:
        for name in ("times", "values"):
            object.__setattr__(self, name, np.asarray(getattr(self, name), dtype=float))
        if self.times.ndim != 1 or self.times.shape != self.values.shape:
            raise InputError(
                f"{self.times.shape} times and {self.values.shape} values; expected one value a time"
            )
        if not (np.isfinite(self.times).all() and np.isfinite(self.values).all()):
            raise InputError("a time or a value is not finite: leave the sample out")
        back = np.flatnonzero(np.diff(self.times) <= 0.0)
        if back.size:
            before, after = self.times[back[0]], self.times[back[0] + 1]
            raise InputError(
                f"time goes from {before:g} s to {after:g} s; expected increasing times: sort them"
            )

    @classmethod
    def from_curve(cls, curve: Curve) -> Self:
        """Return the samples of a curve."""
        return cls(curve.times, curve.values)

    def from_trigger(self, period: float) -> "Samples":
        """Return the samples of one beat at times of 0 to ``period`` [s], in their order."""
        times = np.mod(self.times, period)
        order = np.argsort(times)
        return Samples(times[order], self.values[order])

    def part(self, kept: np.ndarray) -> "Samples":
        """The samples that the mask (k,) keeps."""
        return Samples(self.times[kept], self.values[kept])

    def merged(self, others: "Samples") -> "Samples":
        """These samples and others, in the order of time."""
        times = np.concatenate([self.times, others.times])
        order = np.argsort(times)
        return Samples(times[order], np.concatenate([self.values, others.values])[order])


def averaged_by_phase(samples: Samples, period: float, length: float) -> Samples:
    """Return the means of the samples of all beats in bins of this length [s] of the phase; empty bins are left out.

    A sample that rounding puts before the end of a beat belongs to the first bin of the next one.
    """
    phases = np.mod(samples.times, period)
    phases = np.where(period - phases < ROUNDING * length, phases - period, phases)
    places = np.floor(phases / length + ROUNDING).astype(int)
    counts = np.bincount(places)
    held = counts > 0
    times, values = (np.bincount(places, column)[held] / counts[held] for column in (phases, samples.values))
    return Samples(times, values)
