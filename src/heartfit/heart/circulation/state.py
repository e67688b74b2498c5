"""State of wall and circuit between two time steps."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.circulation.elements import WindkesselState
from heartfit.heart.time_step import TimeStep


@dataclass(frozen=True, eq=False)
class HeartState:
    """State of wall and circuit at one time; ``before`` is the state one step of length ``last`` [s] earlier.

    ``pressures`` (n,) [Pa], 4 or 6 with atria, and ``volumes`` (2,) [m^3]; ``branches`` (2, k) are the flows [m^3/s]
    and openings of the branches, None at rest; ``atria`` (2, 2) are volumes [m^3] of the atria and pressures [Pa] of
    their veins, None without volumes; ``trend`` holds up to two velocities of x, the last one first.
    """

    body: Any
    pressures: Floats
    volumes: Floats
    trees: tuple[WindkesselState, WindkesselState]
    trend: tuple[Floats, ...] = ()
    last: float | None = None
    before: "HeartState | None" = None
    branches: Floats | None = None
    atria: Floats | None = None

    def starting_values(self, step: TimeStep) -> tuple[Floats, tuple[WindkesselState, WindkesselState]]:
        """Volumes and Windkessels at which the effective step starts."""
        before = self.before or self
        systemic, pulmonary = (
            WindkesselState(step.starting_value(now.P_c, then.P_c), step.starting_value(now.q_L, then.q_L))
            for now, then in zip(self.trees, before.trees, strict=True)
        )
        return step.starting_value(self.volumes, before.volumes), (systemic, pulmonary)

    def starting_branches(self, step: TimeStep) -> Floats | None:
        """Flows and openings (2, k) at which the effective step starts, openings between 0 and 1; None at rest."""
        if self.branches is None:
            return None
        before = self.branches if self.before is None else self.before.branches
        start = step.starting_value(self.branches, np.zeros_like(self.branches) if before is None else before)
        start[1] = np.clip(start[1], 0.0, 1.0)
        return start

    def starting_atria(self, step: TimeStep) -> Floats | None:
        """Volumes of the atria and pressures of their veins at which the effective step starts, if any."""
        if self.atria is None:
            return None
        before = self.atria if self.before is None or self.before.atria is None else self.before.atria
        return step.starting_value(self.atria, before)

    def with_walls(self, carry: Callable[[Any], Any]) -> "HeartState":
        """State with the states of its wall, now and one step before, mapped by ``carry``."""
        before = self.before and self.before.with_walls(carry)
        return replace(self, body=carry(self.body), before=before)

    def shift_pressures(self, shifts: Sequence[float]) -> "HeartState":
        """State with the pressures of both Windkessels raised by ``shifts`` (2,) [Pa], now and one step before."""
        systemic, pulmonary = (
            replace(tree, P_c=tree.P_c + shift) for tree, shift in zip(self.trees, shifts, strict=True)
        )
        pressures = self.pressures + np.array([0.0, 0.0, *shifts, 0.0, 0.0])[: len(self.pressures)]
        before = self.before and self.before.shift_pressures(shifts)
        return replace(self, trees=(systemic, pulmonary), pressures=pressures, before=before)
