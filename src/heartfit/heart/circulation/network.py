r"""Network of the circulation: compartments connected by branches.

Ventricles store blood, :math:`\dot V = \sum q_{in} - \sum q_{out}`; arteries respond to their inflow as a Windkessel;
atria have a prescribed pressure, or a volume (:mod:`heartfit.heart.circulation.atria`). Every flow leaves one
compartment and enters another, so blood is conserved by construction.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter
from heartfit.heart.circulation.atria import chamber_table
from heartfit.heart.circulation.elements import PULMONARY, LinearValve, Valve, Windkessel, WindkesselState
from heartfit.roles import (
    COMPARTMENTS,
    Contraction,
    Dynamics,
    Flow,
    Mechanism,
    Narrowing,
    Pressure,
)
from heartfit.roles.laws import (
    Branch,
    Leaflets,
)
from heartfit.roles.sides import VALVES, compartments_of

ATRIOVENTRICULAR, ARTERIAL = LinearValve(open=4e-6), LinearValve(open=5e-6)
ARTERIES, ATRIA = COMPARTMENTS[2:4], COMPARTMENTS[4:]


@dataclass(frozen=True)
class Circulation:
    """The circulation slot: valves, arteries and the resting pressures of the atria."""

    systemic: Windkessel = field(default_factory=Windkessel)
    pulmonary_tree: Windkessel = PULMONARY
    mitral: Valve = ATRIOVENTRICULAR
    aortic: Valve = ARTERIAL
    tricuspid: Valve = ATRIOVENTRICULAR
    pulmonary: Valve = ARTERIAL
    left_atrium: float = parameter(600.0, unit="Pa", symbol="P_{LA}", meaning="left atrial pressure at rest")
    right_atrium: float = parameter(
        200.0, unit="Pa", symbol="P_{RA}", meaning="right atrial pressure at rest"
    )
    first_stroke: float = parameter(
        1.05e-4, unit="m^3", symbol="V_s(0)", meaning="stroke volume that the first arterial pressures hold"
    )

    def trees(self) -> tuple[Windkessel, Windkessel]:
        """Systemic and pulmonary Windkessel."""
        return self.systemic, self.pulmonary_tree

    def start(self, period: float) -> tuple[WindkesselState, WindkesselState]:
        """States of both Windkessels before the first beat."""
        left, right = (tree.periodic_start(self.first_stroke, period) for tree in self.trees())
        return left, right

    def atrial(
        self, time: Floats | float, period: float, mechanisms: Sequence[Mechanism], sides: int = 2
    ) -> Floats:
        """Pressures (sides, ...) of the atria [Pa] at ``time`` (...) [s], left before right."""
        added = mechanism_pressures(ATRIA[:sides], time, period, mechanisms)
        resting = np.array([self.left_atrium, self.right_atrium])[:sides]
        pressures: Floats = (added.T + resting).T
        return pressures


def mechanism_pressures(
    compartments: Sequence[str], time: Floats | float, period: float, mechanisms: Sequence[Mechanism]
) -> Floats:
    """Pressures (k, ...) [Pa] that ``mechanisms`` add to the k compartments at ``time`` (...) [s]."""
    added = np.zeros((len(compartments), *np.shape(time)))
    for mechanism in (m for m in mechanisms if isinstance(m, Pressure)):
        for k, name in enumerate(compartments):
            if name in mechanism.compartments:
                added[k] += mechanism.pressure(name, time, period)  # type: ignore[arg-type]
    return added


def atrial_walls(
    time: Floats | float, period: float, mechanisms: Sequence[Mechanism], sides: int = 2
) -> tuple[Floats, Floats]:
    """Contraction e (...) of the atria and pressures (sides, ...) [Pa] next to it at ``time`` (...) [s].

    They act on atria with a volume, of which the first replaces the pressure of the contraction.
    """
    contraction = np.zeros(np.shape(time))
    for kick in (m for m in mechanisms if isinstance(m, Contraction)):
        contraction += kick.contraction(time, period)  # type: ignore[arg-type]
    others = [m for m in mechanisms if not isinstance(m, Contraction)]
    return contraction, mechanism_pressures(ATRIA[:sides], time, period, others)


@dataclass(frozen=True, eq=False)
class Prescribed:
    """All that time alone prescribes to a network.

    ``laws`` (k, 6) are the coefficients of its branches, ``atrial`` and ``arterial`` (2,) the pressures [Pa] of atria
    without a volume and of the waves in the arteries; ``walls`` are the contraction e of atria with a volume and the
    pressures (2,) [Pa] next to it, None without such an atrium.
    """

    laws: Floats
    atrial: Floats
    arterial: Floats
    walls: tuple[Floats, Floats] | None


class Network:
    """Branches of a circulation with its mechanisms: the valves, narrowed where they are stenosed, then the leaks.

    With ``sides`` = 1 these are the branches among the compartments of the left heart. What time prescribes is kept for
    the last time, so that the neighbours of a heart may share it.
    """

    def __init__(self, circulation: Circulation, mechanisms: Sequence[Mechanism], sides: int = 2) -> None:
        self.circulation, self.mechanisms, self.sides = circulation, tuple(mechanisms), sides
        present = compartments_of(sides)
        valves = {
            name: getattr(circulation, name).law() for name, ends in VALVES.items() if present >= {*ends}
        }
        for mechanism in mechanisms:
            if isinstance(mechanism, Narrowing) and mechanism.valve in valves:
                valves[mechanism.valve] = valves[mechanism.valve].with_narrowing(mechanism.inverse_square())
        leaks = [m for m in mechanisms if isinstance(m, Flow) and present >= {m.upstream, m.downstream}]
        self._valves, self._leaks = list(valves.values()), leaks
        self.names = [*valves, *(type(leak).__name__ for leak in leaks)]
        ends = [*(VALVES[name] for name in valves), *((leak.upstream, leak.downstream) for leak in leaks)]
        self.ends = np.array([[COMPARTMENTS.index(end) for end in pair] for pair in ends])
        moving = {m.valve: m.leaflets() for m in mechanisms if isinstance(m, Dynamics)}
        self.leaflets = np.array([moving.get(name, Leaflets()) for name in self.names])
        self.atria = chamber_table(mechanisms, sides)
        self._last: tuple[tuple[float, float], Prescribed] | None = None

    def equals(self, other: "Network") -> bool:
        """True if the circulation and its mechanisms are those of the ``other``."""
        return (self.circulation, self.mechanisms) == (other.circulation, other.mechanisms)

    def prescribed(self, time: float, period: float) -> Prescribed:
        """Coefficients and pressures at ``time`` [s] in a beat of ``period`` [s]; not to be changed."""
        if self._last is None or self._last[0] != (time, period):
            mechanisms = self.mechanisms
            atrial = self.circulation.atrial(time, period, mechanisms)
            arterial = mechanism_pressures(ARTERIES, time, period, mechanisms)
            walls = None if self.atria is None else atrial_walls(time, period, mechanisms)
            self._last = (time, period), Prescribed(self.laws(time), atrial, arterial, walls)
        return self._last[1]

    def laws(self, time: Floats | float) -> Floats:
        """Coefficients (..., branches, 6) of the branches at ``time`` (...) [s]; see ``Branch``."""
        time = np.asarray(time)
        laws = [*self._valves, *(leak.law(time) for leak in self._leaks)]
        result = np.empty((*time.shape, len(laws), len(Branch._fields)))
        for k, law in enumerate(laws):
            for c, coefficient in enumerate(law):
                result[..., k, c] = coefficient
        return result
