"""The result of a simulation: one periodic beat, or the reason why there is none."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.geometry.mesh import Motion

COMPLETED, FAILED = "completed", "failed"
COST = "cpu_s"
"""Key of the CPU time [s] among the diagnostics; the only one that differs from run to run."""


@dataclass(frozen=True, eq=False, repr=False)
class Beat:
    """One cycle from time 0 to ``period``, in SI units.

    ``time`` (t,); ``volume`` of "lv", "rv"; ``pressure`` of every compartment; ``flow`` through every branch. Time 0 is
    the start of atrial systole; ``trigger`` is the time of the R wave, at which the time of a recording begins:
    :func:`heartfit.observation.beat.beat_curves` shifts the curves. ``status`` is "completed", or "failed" with a
    ``reason``; ``diagnostics`` holds the number of beats, the drift, the cost and the change of wall volume.
    ``positions`` (t, n, 3) are the nodes at every time if the simulation kept them, else None.
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

    def __repr__(self) -> str:
        if not self.completed:
            return f"Beat(failed: {self.reason})"
        ranges = (
            f"{name} {1e6 * values.min():.1f} to {1e6 * values.max():.1f} mL"
            for name, values in self.volume.items()
        )
        return f"Beat({self.period:g} s: {', '.join(ranges)})"

    def signals(self) -> dict[str, Floats]:
        """Curves (t,) by name: "lv_volume", "aorta_pressure", "mitral_flow", ...; empty for a failed beat."""
        groups = {"volume": self.volume, "pressure": self.pressure, "flow": self.flow}
        return {f"{name}_{kind}": values for kind, group in groups.items() for name, values in group.items()}

    def reproducible_diagnostics(self) -> dict[str, float]:
        """Diagnostics without the CPU time: equal for equal beats."""
        return {name: value for name, value in self.diagnostics.items() if name != COST}

    @property
    def completed(self) -> bool:
        """True if the beat holds curves that can be observed."""
        return self.status == COMPLETED


def failed_beat(reason: str, period: float, trigger: float, diagnostics: Mapping[str, float]) -> Beat:
    """Beat without samples, which states the ``reason`` of the failure."""
    return Beat(np.empty(0), {}, {}, {}, period, trigger, FAILED, reason, diagnostics)


def nodal_motion(beat: Beat) -> Motion:
    """Motion of the nodes from the trigger on; raises ValueError if the beat did not keep its positions."""
    if beat.positions is None:
        raise ValueError("beat: expected positions of the nodes; simulate with Numerics(keep_positions=True)")
    times = np.mod(beat.time[:-1] - beat.trigger, beat.period)
    order = np.argsort(times)
    return Motion(times[order], beat.period, beat.positions[:-1][order])
