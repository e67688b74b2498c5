"""The slots of the wall, and what mechanisms make of them."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from heartfit.electrophysiology.control import Control
from heartfit.geometry.arrays import Floats
from heartfit.geometry.bullseye import REGIONS
from heartfit.mechanics.active.bcs import BestelClementSorine
from heartfit.mechanics.passive.law import Passive
from heartfit.mechanics.passive.mooney_rivlin import MooneyRivlin
from heartfit.mechanics.passive.stiffened import Stiffened
from heartfit.mechanics.support import Support
from heartfit.mechanism import Amendment, Availability, Delay, Mechanism, Relaxation, Stress


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

    def under(self, mechanisms: Sequence[Mechanism], period: float) -> "Tissue":
        """The tissue with constants, stresses, tails and regions as ``mechanisms`` make them at a ``period``, s."""
        amended = self
        for each in (m for m in mechanisms if isinstance(m, Amendment)):
            amended = _amended(amended, each.amends.split("."), partial(each.amended, period=period))
        return amended._with_parts(mechanisms)

    def _with_parts(self, mechanisms: Sequence[Mechanism]) -> "Tissue":
        stresses = tuple(m for m in mechanisms if isinstance(m, Stress))
        tails = tuple(m for m in mechanisms if isinstance(m, Relaxation))
        regional = tuple(m for m in mechanisms if isinstance(m, Availability | Delay))
        return replace(
            self,
            passive=Stiffened(self.passive, stresses) if stresses else self.passive,
            control=replace(self.control, tails=tails) if tails else self.control,
            regional=regional,
        )


def _amended(part: Any, path: Sequence[str], amend: Callable[[float], float]) -> Any:
    """The part with the constant at the end of the ``path`` amended."""
    name, *rest = path
    held = getattr(part, name)
    return replace(part, **{name: _amended(held, rest, amend) if rest else amend(held)})
