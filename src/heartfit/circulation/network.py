r"""The circuit around the ventricles: compartments joined by branches.

Ventricles keep their blood, :math:`\dot V = \sum q_{in} - \sum q_{out}`; arteries answer their inflow with a
Windkessel; atria have a prescribed pressure. Flow leaves one compartment and enters another, so blood is
conserved by construction.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numba import njit

from heartfit.branch import Branch, inertial_flow
from heartfit.circulation.valves import LinearValve, Valve
from heartfit.circulation.windkessel import PULMONARY, Windkessel, WindkesselState
from heartfit.geometry.arrays import Floats
from heartfit.mechanism import COMPARTMENTS, Flow, Mechanism, Narrowing, Pressure
from heartfit.parameter import parameter

ATRIOVENTRICULAR, ARTERIAL = LinearValve(open=4e-6), LinearValve(open=5e-6)
ARTERIES, ATRIA = COMPARTMENTS[2:4], COMPARTMENTS[4:]
VALVES = {
    "mitral": ("left_atrium", "lv"),
    "aortic": ("lv", "aorta"),
    "tricuspid": ("right_atrium", "rv"),
    "pulmonary": ("rv", "pulmonary_artery"),
}


@dataclass(frozen=True)
class Circulation:
    """The circulation slot: valves, arteries and the resting pressure of the atria."""

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
        """State of both Windkessels before the first beat."""
        left, right = (tree.periodic_start(self.first_stroke, period) for tree in self.trees())
        return left, right

    def atrial(
        self, time: Floats | float, period: float, mechanisms: Sequence[Mechanism], sides: int = 2
    ) -> Floats:
        """Pressures (2, ...) of the left and right atrium at ``time`` (...); or (1, ...) of the left ``sides``."""
        added = added_pressures(ATRIA[:sides], time, period, mechanisms)
        resting = np.array([self.left_atrium, self.right_atrium])[:sides]
        pressures: Floats = (added.T + resting).T
        return pressures


def added_pressures(
    compartments: Sequence[str], time: Floats | float, period: float, mechanisms: Sequence[Mechanism]
) -> Floats:
    """Pressures (k, ...) that mechanisms add to the k compartments at ``time`` (...)."""
    added = np.zeros((len(compartments), *np.shape(time)))
    for each in (m for m in mechanisms if isinstance(m, Pressure)):
        for k, name in enumerate(compartments):
            if name in each.compartments:
                added[k] += each.pressure(name, time, period)  # type: ignore[arg-type]
    return added


class Network:
    """The branches of a circulation with its mechanisms: valves, some narrowed, then whatever leaks.

    With one of the ``sides`` these are the branches among the compartments of the left heart.
    """

    def __init__(self, circulation: Circulation, mechanisms: Sequence[Mechanism], sides: int = 2) -> None:
        held = {name for i, name in enumerate(COMPARTMENTS) if i % 2 < sides}
        valves = {name: getattr(circulation, name).law() for name, ends in VALVES.items() if held >= {*ends}}
        for each in mechanisms:
            if isinstance(each, Narrowing) and each.valve in valves:
                valves[each.valve] = valves[each.valve].narrowed(each.inverse_square())
        leaks = [m for m in mechanisms if isinstance(m, Flow) and held >= {m.upstream, m.downstream}]
        self._valves, self._leaks = list(valves.values()), leaks
        self.names = [*valves, *(type(leak).__name__ for leak in leaks)]
        ends = [*(VALVES[name] for name in valves), *((leak.upstream, leak.downstream) for leak in leaks)]
        self.ends = np.array([[COMPARTMENTS.index(end) for end in pair] for pair in ends])

    def laws(self, time: Floats | float) -> Floats:
        """Coefficients (..., branches, 5) of the branches at ``time`` (...); see :class:`~heartfit.branch.Branch`."""
        time = np.asarray(time)
        laws = [*self._valves, *(leak.law(time) for leak in self._leaks)]
        result = np.empty((*time.shape, len(laws), len(Branch._fields)))
        for k, law in enumerate(laws):
            for c, coefficient in enumerate(law):
                result[..., k, c] = coefficient
        return result


class NetworkStep:
    """Flows of one step as functions of the unknown pressures (4,) at its end."""

    def __init__(
        self, circulation: Circulation, mechanisms: Sequence[Mechanism], time: float, dt: float, period: float
    ) -> None:
        self._circulation, network = circulation, Network(circulation, mechanisms)
        self.dt, self._names = dt, network.names
        self.atrial = circulation.atrial(time, period, mechanisms)
        self._arterial = added_pressures(ARTERIES, time, period, mechanisms)
        self.ends, self.laws = network.ends, network.laws(time)[None]
        self.moving = np.zeros((3, len(self.ends)))

    def flows(self, pressures: Floats) -> dict[str, float]:
        """Flow of every branch by name."""
        self.outflow(pressures)
        return dict(zip(self._names, self.moving[2].tolist(), strict=True))

    def outflow(self, pressures: Floats) -> tuple[Floats, Floats]:
        """Net outflow (4,) of the unknown compartments and its Jacobian (4, 4)."""
        out, slope = np.empty((1, 4)), np.empty((4, 4))
        net_outflow(self.ends, self.laws, self.moving, self.atrial[None], 0, pressures, out, slope)
        return out[0], slope

    def windkessels(self, trees: Sequence[WindkesselState]) -> Floats:
        """Rows (a, b) of the arterial pressures a + b q at the end of the step, aorta first."""
        sides = zip(self._circulation.trees(), trees, strict=True)
        rows = np.array([tree.affine(held, self.dt) for tree, held in sides])
        rows[:, 0] += self._arterial
        return rows

    def advance(
        self, trees: Sequence[WindkesselState], pressures: Floats
    ) -> tuple[WindkesselState, WindkesselState]:
        """States of the Windkessels at the end of the step, given the pressures there."""
        out, _ = self.outflow(pressures)
        systemic, pulmonary = self._circulation.trees()
        return systemic.advance(trees[0], -out[2], self.dt), pulmonary.advance(trees[1], -out[3], self.dt)


@njit(cache=True, error_model="numpy", inline="always")
def net_outflow(ends, laws, moving, atria, t, p, out, slope):  # type: ignore[no-untyped-def]
    """Fill the net outflow (.., 2 v), in row 0, of v ventricles and their arteries and its Jacobian (2 v, 2 v).

    p (2 v,) are their pressures, ``atria`` (.., 2) those of the atria and ``laws`` (.., k, 5) those of the branches
    with the given ``ends`` (k, 2) at many times, of which t is the one. ``moving`` (3, k) are the inertances of the
    branches per length of the step, the flows it starts from and, filled, the flows.
    """
    n = p.size
    for i in range(n):
        out[0, i] = 0.0
        for j in range(n):
            slope[i, j] = 0.0
    for k in range(ends.shape[0]):
        upstream, downstream = ends[k, 0], ends[k, 1]
        i, j = _unknown(upstream, n // 2), _unknown(downstream, n // 2)
        up = p[i] if i >= 0 else atria[t, upstream - 4]
        down = p[j] if j >= 0 else atria[t, downstream - 4]
        q, dq = inertial_flow(laws, t, k, up - down, moving[0, k], moving[1, k])
        moving[2, k] = q
        if i >= 0:
            out[0, i] += q
            slope[i, i] += dq
        if j >= 0:
            out[0, j] -= q
            slope[j, j] += dq
        if i >= 0 and j >= 0:
            slope[i, j] -= dq
            slope[j, i] -= dq


@njit(cache=True, error_model="numpy", inline="always")
def _unknown(compartment, v):  # type: ignore[no-untyped-def]
    """Row of a compartment's pressure among the unknowns; -1 of an atrium."""
    if compartment < 2:
        return compartment
    return v + compartment - 2 if compartment < 4 else -1
