"""The slots of the wall, and what mechanisms make of them."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from heartfit.electrophysiology.control import Control
from heartfit.geometry.arrays import Floats
from heartfit.geometry.bullseye import REGIONS
from heartfit.mechanics.active.bcs import BestelClementSorine
from heartfit.mechanics.passive.law import Passive
from heartfit.mechanics.passive.mooney_rivlin import MooneyRivlin
from heartfit.mechanics.passive.stiffened import Stiffened
from heartfit.mechanics.support import Support
from heartfit.mechanism import Availability, Delay, Mechanism, Relaxation, Stress


@dataclass(frozen=True)
class Tissue:
    """The slots of the wall: what it is made of, what drives it, what holds it and how it is discretised.

    ``regional``: what differs between its regions.
    """

    passive: Passive = field(default_factory=MooneyRivlin)
    active: BestelClementSorine = field(default_factory=BestelClementSorine)
    control: Control = field(default_factory=Control)
    support: Support = field(default_factory=Support)
    element: str = "mixed"
    regional: tuple[Availability | Delay, ...] = ()

    def delays(self) -> Floats:
        """By how much, s, each region is activated later (18,); see :class:`heartfit.mechanism.Delay`."""
        return sum((each.delay() for each in self.regional if isinstance(each, Delay)), np.zeros(REGIONS))

    def losses(self) -> Floats:
        """Share of the bridges missing in each region (18,)."""
        each_kept = (1.0 - each.lost() for each in self.regional if isinstance(each, Availability))
        return 1.0 - np.prod([*each_kept, np.ones(REGIONS)], axis=0)

    def under(self, mechanisms: Sequence[Mechanism]) -> "Tissue":
        """The tissue with the stresses, tails and regional differences among ``mechanisms``."""
        stresses = tuple(m for m in mechanisms if isinstance(m, Stress))
        tails = tuple(m for m in mechanisms if isinstance(m, Relaxation))
        regional = tuple(m for m in mechanisms if isinstance(m, Availability | Delay))
        return replace(
            self,
            passive=Stiffened(self.passive, stresses) if stresses else self.passive,
            control=replace(self.control, tails=tails) if tails else self.control,
            regional=regional,
        )
