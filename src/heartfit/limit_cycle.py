r"""How far a beat is from its limit cycle, and what brings the next one nearer.

The memory tau of a Windkessel is longer than a beat; its pressure is moved to where the stroke volume of the next beat
will hold it, as far as the last beat, or the last two, can tell.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.circulation.windkessel import Windkessel, WindkesselState
from heartfit.geometry.arrays import Floats

RESPONSES = 1.1, 1.0
"""By how much the lack of the aorta and of the pulmonary artery falls, Pa, for each Pa more at the start of a beat: a
higher pressure lowers the stroke volume too. First guesses; after two beats it is measured."""

CREDIBLE = 0.7, 4.0
"""Responses between which a measured one is believed; below are hearts that changed for other reasons."""

SURPLUS = 0.3
"""Part of what a ventricle lost over a beat that this beat ejected beyond those to come, as it began fuller."""


@dataclass(frozen=True, eq=False)
class Recurrence:
    """A beat's cavity volumes (t, v) and the states of the v Windkessels at its start and at its end."""

    volumes: Floats
    first: Sequence[WindkesselState]
    last: Sequence[WindkesselState]

    def drift(self) -> float:
        """Largest change over the beat of a volume, over stroke volume, and of a Windkessel's pressure, over itself."""
        stroke = self.volumes.max(axis=0) - self.volumes.min(axis=0)
        in_volume = np.abs(self.volumes[-1] - self.volumes[0]) / stroke
        in_pressure = [abs(b.P_c / a.P_c - 1.0) for a, b in zip(self.first, self.last, strict=True)]
        return float(max(*in_volume, *in_pressure))

    def shifts(
        self, trees: Sequence[Windkessel], period: float, before: "Recurrence | None" = None
    ) -> list[float]:
        """By how much to raise the pressures of the Windkessels, Pa, after this beat; ``before`` it was that one."""
        lacks = self._lacks(trees, period)
        responses: Sequence[float] = RESPONSES
        if before is not None:
            earlier = before._lacks(trees, period)
            rises = [new.P_c - old.P_c for new, old in zip(self.first, before.first, strict=True)]
            responses = list(map(_response, earlier, lacks, rises, RESPONSES))
        states = zip(self.first, self.last, strict=True)
        changes = [last.P_c - first.P_c for first, last in states]
        return [lack / each - change for lack, each, change in zip(lacks, responses, changes, strict=False)]

    def _lacks(self, trees: Sequence[Windkessel], period: float) -> list[float]:
        surplus = SURPLUS * (self.volumes[0] - self.volumes[-1])
        sides = zip(trees, self.first, self.last, surplus.tolist(), strict=True)
        return [tree.lack(first, last, period, more) for tree, first, last, more in sides]


def _response(earlier: float, lack: float, rise: float, guess: float) -> float:
    """How the lack answered a rise of the pressure, or the guess where that cannot be."""
    low, high = CREDIBLE
    fallen = (earlier - lack) / rise if rise else guess
    return fallen if low < fallen < high else guess
