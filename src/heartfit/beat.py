"""The result of a simulation: one periodic beat, or the reason why there is none."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.motion import Motion

COMPLETED, FAILED = "completed", "failed"
COST = "cpu_s"
"""Of the diagnostics, s of CPU; no two runs agree about it."""


@dataclass(frozen=True, eq=False)
class Beat:
    """One cycle from time 0 to ``period``, SI units.

    ``time`` (t,); ``volume`` of "lv", "rv"; ``pressure`` of every compartment; ``flow`` through every branch;
    ``trigger`` is the simulated time of the measured frame 0. ``status`` is "completed" or "failed" with a
    ``reason``; ``diagnostics`` tells beats, drift, cost and what happened to the wall. ``positions`` (t, n, 3)
    are the nodes at every time, when they were asked for.
    """

    time: Floats
    volume: Mapping[str, Floats]
    pressure: Mapping[str, Floats]
    flow: Mapping[str, Floats]
    period: float
    trigger: float
    status: str = COMPLETED
    reason: str = ""
    diagnostics: Mapping[str, float] = field(default_factory=dict)
    positions: Floats | None = None

    def signals(self) -> dict[str, Floats]:
        """Every curve (t,) by name: "lv_volume", "aorta_pressure", "mitral_flow", ...; none of a failed beat."""
        groups = {"volume": self.volume, "pressure": self.pressure, "flow": self.flow}
        return {f"{name}_{kind}": values for kind, group in groups.items() for name, values in group.items()}

    def findings(self) -> dict[str, float]:
        """The diagnostics but for the cost: the same for the same beat."""
        return {name: value for name, value in self.diagnostics.items() if name != COST}

    @property
    def completed(self) -> bool:
        """Whether the beat can be observed."""
        return self.status == COMPLETED


def failed_beat(reason: str, period: float, trigger: float, diagnostics: Mapping[str, float]) -> Beat:
    """A beat that was not reached, with the reason; it holds no samples."""
    return Beat(np.empty(0), {}, {}, {}, period, trigger, FAILED, reason, diagnostics)


def motion_of(beat: Beat) -> Motion:
    """The nodes of a beat that kept them, from the trigger on; raises ValueError if it did not."""
    if beat.positions is None:
        raise ValueError("beat: its nodes were not kept; simulate with keep_positions")
    times = np.mod(beat.time[:-1] - beat.trigger, beat.period)
    order = np.argsort(times)
    return Motion(times[order], beat.period, beat.positions[:-1][order])
