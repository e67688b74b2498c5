r"""Misfit of a simulated curve: its residual, averaged over a phase of the beat, and the noise of that mean.

Of the samples i = 1 ... n in a phase,

.. math:: m = \frac1n \sum_i (y^{simulated}_i - y^{measured}_i), \qquad
          s^2 = \frac1{n^2} \sum_{ij} \Sigma_{ij} ,

with the covariance Sigma of the noise of the samples. A fitted simulation follows the noise, so that s is rather too
large than too small. The departure of a curve is the mean of the phase with the largest \|m\| / s.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.discovery.sphere_model.cause import Diagnosis, Trace
from heartfit.observation.beat import BeatPhases

CLEAR_MISFIT = 2.6
"""Standard deviations from which a departure exceeds the noise: of curves within their noise, one in twenty has a mean
beyond it in one of six phases."""
PARTS = 8
"""Parts of a beat without phases."""


@dataclass(frozen=True)
class Departure:
    """Mean of simulated minus measured values of a curve over a phase [SI], its standard deviation, and their number.

    phase: part of the beat from a time to another one where the beat has no phases.
    """

    curve: str
    phase: str
    size: float
    sd: float
    samples: int

    @property
    def deviations(self) -> float:
        """The size in standard deviations; positive where the simulation is too high."""
        return self.size / self.sd

    @property
    def clear(self) -> bool:
        """True if the departure exceeds noise."""
        return abs(self.deviations) >= CLEAR_MISFIT


def phase_names(times: Floats, period: float, phases: BeatPhases | None) -> np.ndarray:
    """Return the phase of each time (k,) [s]; without phases, eighths of the beat by their limits in ms."""
    if phases is not None:
        return np.array(phases.names_at(times))
    parts = (np.mod(times, period) / period * PARTS).astype(int) % PARTS
    limits = np.rint(1e3 * period * np.arange(PARTS + 1) / PARTS).astype(int)
    return np.array([f"the beat from {limits[part]} to {limits[part + 1]} ms" for part in parts])


def deviation_of_means(covariance: Floats, names: Sequence[str] | np.ndarray) -> Floats:
    """Return the standard deviation (k,) of the mean over all samples with the name of each.

    covariance (k, k): of the noise of the samples; names (k,): of their phases.
    """
    same = np.asarray(names)[:, None] == np.asarray(names)
    weights = same / same.sum(axis=1, keepdims=True)
    return np.asarray(np.sqrt(np.einsum("ki,ij,kj->k", weights, covariance, weights)))


def largest_departure(curve: str, difference: Floats, sd: Floats, names: np.ndarray) -> Departure:
    """Return the departure of the phase in which it is clearest.

    difference (k,): simulated minus measured values; sd (k,): of the mean of the phase of each; names (k,): of phases.
    """
    means = [
        Departure(curve, str(name), float(difference[inside].mean()), float(sd[inside][0]), int(inside.sum()))
        for name in dict.fromkeys(names.tolist())
        for inside in [names == name]
    ]
    return max(means, key=lambda departure: abs(departure.deviations))


def departures(diagnosis: Diagnosis, extended: bool = False) -> list[Departure]:
    """Return the departure of each curve of the simulation that is shown, without or (``extended``) with the cause."""
    return [
        _departure(trace, diagnosis, trace.extended if extended else trace.none) for trace in diagnosis.traces
    ]


def _departure(trace: Trace, diagnosis: Diagnosis, simulated: Floats) -> Departure:
    names = phase_names(trace.times, diagnosis.period, diagnosis.phases)
    sd = trace.mean_noise
    if sd is None:
        sd = deviation_of_means(np.diag(trace.noise**2), names)
    return largest_departure(trace.curve, simulated - trace.measured, sd, names)
