"""The phases of a simulated beat, by its valves.

A valve is open while its flow exceeds a small part of its peak. Between the mitral valve's closing and the aortic one's
opening lies the isovolumic contraction, between the aortic valve's closing and the mitral one's opening the isovolumic
relaxation. Filling is divided where its flow has fallen to a third of its early peak, and where it is least before the
atria contract.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.observation.curve import Curve

PHASES = (
    "isovolumic contraction",
    "ejection",
    "isovolumic relaxation",
    "early filling",
    "diastasis",
    "atrial systole",
)
OPEN = 0.02
"""Flow over its peak above which a valve counts as open."""
SLOW = 1.0 / 3.0
"""Flow over its early peak below which filling is no longer early."""
EARLY, LATE = 0.4, 0.6
"""Shares of the filling's duration before which lies the early peak, and after which the atrial one."""


@dataclass(frozen=True, eq=False)
class BeatPhases:
    """When each of PHASES starts (6,), s after the trigger, within the period, s."""

    starts: Floats
    period: float

    @classmethod
    def of(cls, curves: Mapping[str, Curve]) -> "BeatPhases":
        """From the "aortic_flow" and "mitral_flow" of a beat; raises ValueError for a valve that never moves."""
        ejection, filling = (_open(curves[f"{valve}_flow"]) for valve in ("aortic", "mitral"))
        mitral = filling.values
        early = int(mitral[: max(1, int(EARLY * len(mitral)))].argmax())
        kick = int(LATE * len(mitral)) + int(mitral[int(LATE * len(mitral)) :].argmax())
        atrial = early + int(mitral[early : kick + 1].argmin())
        slow = early + int(np.argmax(mitral[early : atrial + 1] <= SLOW * mitral[early]))
        diastasis = slow if mitral[slow] <= SLOW * mitral[early] else atrial
        times = [
            filling.times[-1],
            ejection.times[0],
            ejection.times[-1],
            filling.times[0],
            filling.times[diastasis],
            filling.times[atrial],
        ]
        return cls(np.mod(times, filling.period), filling.period)

    def at(self, times: Floats) -> list[str]:
        """The phase at each of the times, s after the trigger."""
        since = np.mod(np.asarray(times)[:, None] - self.starts, self.period)
        return [PHASES[index] for index in since.argmin(axis=1)]

    def spans(self) -> list[tuple[str, float, float]]:
        """Name, start and end, s after the trigger, of each phase within one period; one that wraps is in two parts."""
        ends = np.roll(self.starts, -1)
        parts: list[tuple[str, float, float]] = []
        for name, start, end in zip(PHASES, self.starts.tolist(), ends.tolist(), strict=True):
            whole = [(start, end)] if start <= end else [(start, self.period), (0.0, end)]
            parts += [(name, first, last) for first, last in whole]
        return sorted(parts, key=lambda part: part[1])


def _open(flow: Curve) -> Curve:
    """The samples while the valve is open, in time from its opening; times may exceed the period."""
    is_open = flow.values > OPEN * flow.values.max()
    if is_open.all() or not is_open.any():
        raise ValueError("phases of the beat: a valve never opens or never closes")
    opening = int(np.flatnonzero(is_open & ~np.roll(is_open, 1))[0])
    turned = Curve(_unrolled(flow, opening), np.roll(flow.values, -opening), flow.period)
    last = int(np.roll(is_open, -opening).argmin()) + 1
    return Curve(turned.times[:last], turned.values[:last], flow.period)


def _unrolled(flow: Curve, first: int) -> Floats:
    """Times from sample ``first`` on, increasing over one period."""
    times: Floats = np.concatenate([flow.times[first:], flow.times[:first] + flow.period])
    return times
