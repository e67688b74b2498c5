"""Where a simulation departs most from what was measured: which curve, when in the beat, by how much, which way."""

from dataclasses import dataclass

import numpy as np

from heartfit.diagnosis.cause import Diagnosis, Trace

CLEAR = 2.0
"""Standard deviations from which a departure is told from noise."""


@dataclass(frozen=True)
class Departure:
    """Simulated less measured of a curve, SI, the standard deviation of that, and when: s after the trigger, and phase.

    The phase is empty where the beat has none.
    """

    curve: str
    phase: str
    time: float
    size: float
    sd: float

    @property
    def deviations(self) -> float:
        """The size in standard deviations; positive where the simulation is too high."""
        return self.size / self.sd

    @property
    def clear(self) -> bool:
        """Whether it is more than noise."""
        return abs(self.deviations) >= CLEAR


def departures(diagnosis: Diagnosis) -> list[Departure]:
    """The greatest of each curve, of the simulation without a cause."""
    return [_departure(trace, diagnosis) for trace in diagnosis.traces]


def _departure(trace: Trace, diagnosis: Diagnosis) -> Departure:
    worst = int(np.argmax(np.abs(trace.lacking) / trace.band))
    time = float(trace.times[worst] % diagnosis.period)
    phase = "" if diagnosis.phases is None else diagnosis.phases.at(np.array([time]))[0]
    return Departure(trace.curve, phase, time, -float(trace.lacking[worst]), float(trace.band[worst]))
