r"""How far a beat is from its limit cycle, and what brings the next one nearer.

The memory tau of a Windkessel is longer than a beat; its pressure is shifted towards where the stroke volume of the
last beat would hold it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.circulation.windkessel import Windkessel, WindkesselState
from heartfit.geometry.arrays import Floats

SHIFT = 0.85
"""Part of the periodic pressure shift that is taken: a higher pressure lowers the stroke volume, which undoes the rest.
With it 14 of 16 coarse hearts drift by less than 1 % in their second beat, of the study's sigma points a fifth: it is
not tuned to them."""


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

    def shifts(self, trees: Sequence[Windkessel], period: float) -> list[float]:
        """By how much to raise the pressures of the Windkessels, Pa, before the next beat."""
        sides = zip(trees, self.first, self.last, strict=True)
        return [SHIFT * tree.periodic_shift(before, after, period) for tree, before, after in sides]
