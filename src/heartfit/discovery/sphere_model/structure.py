r"""Structural discrepancy: what the sphere leaves of a beat that another simulator, or nature, has made.

A discrepancy :math:`\delta` is a curve over the phase of the beat, of the left volume and pressure jointly, Gaussian
with a mean and a covariance. Three sources give them.

*Healthy hearts* of other simulators, or a group of controls. The sphere leaves the residuals r_n of N of them:

.. math:: S(\phi, \phi') = (1 - \lambda) \frac{1}{N} \sum_n r_n(\phi) r_n(\phi')
          + \lambda\, \sigma(\phi) \sigma(\phi') \rho(\phi - \phi'), \quad
          \sigma^2(\phi) = \frac{1}{N} \sum_n r_n^2(\phi) ,

of mean zero: what the next simulator leaves has no known sign. The second term shrinks S towards the same variances
with a smooth correlation rho within each curve, because a few hearts span a few directions only.

*Another recording of the same heart*, to which the sphere was fitted with noise Sigma and s^2 S. It shares a part
:math:`\beta` of the discrepancy, of which its residual r tells

.. math:: E[\delta \mid r] = \beta\, s^2 S C^{-1} r, \quad
          \mathrm{Cov}[\delta \mid r] = s^2 S - \beta^2 s^2 S C^{-1} S s^2 , \quad C = \Sigma + s^2 S .

Volumes stand over the end-diastolic volume, pressures over their range. The phase runs evenly from the half rise of
the pressure to its half fall, and evenly on to the next rise, so that beats of any rate and length of systole match.

References: Kennedy and O'Hagan 2001, doi:10.1111/1467-9868.00294; Ledoit and Wolf 2004,
doi:10.1016/S0047-259X(03)00096-4.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.linalg import block_diag, cho_factor, cho_solve

from heartfit.core.arrays import Floats
from heartfit.discovery.inference.data import STRUCTURE_SCALES, Block

PHASES = 100
"""Number of equidistant phases of a discrepancy."""
FALL = 0.4
"""Phase of the half fall of the pressure; that of its half rise is 0."""
CURVES = ("lv_volume", "lv_pressure")
"""Curves of a discrepancy, one after the other."""
SHRINKAGE, CORRELATION = 0.5, 0.06
"""lambda, and the standard deviation of rho, a Gaussian of the phase."""
SHARED = 0.95
"""beta: correlation of the discrepancies of two recordings of one heart."""
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


@dataclass(frozen=True, eq=False)
class Structure:
    """Mean (2 PHASES,) and covariance (2 PHASES, 2 PHASES) of a discrepancy over the phases of both curves.

    scales: of the covariance, equally likely.
    """

    mean: Floats
    covariance: Floats
    scales: tuple[float, ...] = STRUCTURE_SCALES

    @classmethod
    def from_residuals(cls, residuals: Floats) -> "Structure":
        """Learn from residuals (N, 2 PHASES) of healthy hearts."""
        empirical = residuals.T @ residuals / residuals.shape[0]
        sd = np.sqrt(np.diag(empirical))
        lags = np.abs(np.subtract.outer(np.arange(PHASES), np.arange(PHASES))) / PHASES
        correlation = np.exp(-0.5 * (np.minimum(lags, 1.0 - lags) / CORRELATION) ** 2)
        target = np.outer(sd, sd) * block_diag(correlation, correlation)
        return cls(np.zeros_like(sd), (1.0 - SHRINKAGE) * empirical + SHRINKAGE * target)

    def after(self, weights: Floats, noise: Floats, residual: Floats, scale: float) -> "Structure":
        """Return the discrepancy of a second recording, given the residual (n,) of the first.

        weights (n, 2 PHASES): of the first recording; noise (n, n): Sigma; scale: s.
        """
        prior = scale**2 * self.covariance
        cross = weights @ prior
        factor = cho_factor(noise + cross @ weights.T)
        mean = SHARED * cross.T @ cho_solve(factor, residual)
        return Structure(mean, prior - SHARED**2 * cross.T @ cho_solve(factor, cross), (1.0,))


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
