"""Phases of a beat between the landmarks of its pressure, and curves over these phases.

Volumes stand over the end-diastolic volume, pressures over their range. The phase runs evenly from the half rise of
the pressure to its half fall, and evenly on to the next rise, so that beats of any rate and length of systole match.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.data import Block

PHASES = 100
"""Number of equidistant phases of a curve."""
FALL = 0.4
"""Phase of the half fall of the pressure; that of its half rise is 0."""
CURVES = ("lv_volume", "lv_pressure")
"""Curves over the phases, one after the other."""
FINE = 1000
"""Samples of the beat between which landmarks are found."""


@dataclass(frozen=True)
class Landmarks:
    """Times of the half rise and half fall of the left ventricular pressure, and period [s]."""

    rise: float
    fall: float
    period: float

    @classmethod
    def from_pressure(cls, times: Floats, values: Floats, period: float) -> "Landmarks":
        """Return the landmarks of samples (k,) at times (k,) [s]."""
        fine = np.arange(FINE) * period / FINE
        curve = np.interp(fine, times, values, period=period)
        peak = int(np.argmax(curve))
        high = np.roll(curve > 0.5 * (curve.min() + curve.max()), -peak)
        after, before = int(np.argmin(high)), int(np.argmin(high[::-1]))
        return cls(float(fine[(peak - before) % FINE]), float(fine[(peak + after) % FINE]), period)

    def phases(self, times: Floats) -> Floats:
        """Phases (k,) of times (k,) [s], 0 <= phase < 1."""
        systole = (self.fall - self.rise) % self.period
        since = np.mod(times - self.rise, self.period)
        late = FALL + (1.0 - FALL) * (since - systole) / (self.period - systole)
        return np.where(since < systole, FALL * since / systole, late)


@dataclass(frozen=True)
class Frame:
    """Landmarks of a recorded beat and the unit [SI] of its discrepancy by curve."""

    landmarks: Landmarks
    units: Mapping[str, float]

    def weights(self, blocks: Sequence[Block]) -> Floats:
        """Weights (n, 2 PHASES) [SI] that take a discrepancy to the samples of the blocks.

        A curve other than the two has none: of the aorta nothing is learnt.
        """
        return np.concatenate([self._block_weights(block) for block in blocks])

    def _block_weights(self, block: Block) -> Floats:
        if block.curve not in CURVES:
            return np.zeros((block.times.size, len(CURVES) * PHASES))
        return self.units[block.curve] * _weights(block.curve, self.landmarks.phases(block.times))

    def residual(self, blocks: Sequence[Block], parts: Sequence[Floats]) -> Floats:
        """Residual (2 PHASES,) over the phases of both curves, from those of the samples (k,) of each block."""
        curves = {
            block.curve: self._over_phases(block, part) for block, part in zip(blocks, parts, strict=True)
        }
        return np.concatenate([curves[name] for name in CURVES])

    def _over_phases(self, block: Block, values: Floats) -> Floats:
        phases = self.landmarks.phases(block.times)
        order = np.argsort(phases)
        over = np.interp(np.arange(PHASES) / PHASES, phases[order], values[order], period=1.0)
        return np.asarray(over / self.units[block.curve], np.float64)


def _weights(curve: str, phases: Floats) -> Floats:
    """Weights (k, 2 PHASES) that interpolate a discrepancy at phases (k,)."""
    place = phases * PHASES
    left = np.floor(place).astype(int)
    share, rows = place - left, np.arange(phases.size)
    weights = np.zeros((phases.size, len(CURVES) * PHASES))
    first = CURVES.index(curve) * PHASES
    weights[rows, first + left % PHASES] += 1.0 - share
    weights[rows, first + (left + 1) % PHASES] += share
    return weights
