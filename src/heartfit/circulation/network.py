r"""The circuit around the ventricles: compartments joined by branches.

Ventricles keep their blood, :math:`\dot V = \sum q_{in} - \sum q_{out}`; arteries answer their inflow with a
Windkessel; atria have a prescribed pressure. Flow leaves one compartment and enters another, so blood is
conserved by construction.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numba import njit

from heartfit.branch import branch_flow
from heartfit.circulation.valves import LinearValve, Valve
from heartfit.circulation.windkessel import PULMONARY, Windkessel, WindkesselState
from heartfit.geometry.arrays import Floats
from heartfit.mechanism import COMPARTMENTS, Flow, Mechanism, Pressure
from heartfit.parameter import parameter

ATRIOVENTRICULAR, ARTERIAL = LinearValve(open=4e-6), LinearValve(open=5e-6)
ATRIA = COMPARTMENTS[4:]
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
    aorta_start: float = parameter(
        11e3, unit="Pa", symbol="P_{ao}(0)", meaning="aortic pressure of the first beat"
    )
    pulmonary_start: float = parameter(
        1.6e3, unit="Pa", symbol="P_{pa}(0)", meaning="pulmonary artery pressure of the first beat"
    )

    def trees(self) -> tuple[Windkessel, Windkessel]:
        """Systemic and pulmonary Windkessel."""
        return self.systemic, self.pulmonary_tree

    def start(self) -> tuple[WindkesselState, WindkesselState]:
        """State of both Windkessels before the first beat."""
        return WindkesselState(self.aorta_start), WindkesselState(self.pulmonary_start)

    def atrial(self, time: Floats | float, period: float, mechanisms: Sequence[Mechanism]) -> Floats:
        """Pressures (2, ...) of the left and right atrium at ``time`` (...)."""
        still = np.zeros(np.shape(time))
        added = [
            sum((m.pressure(atrium, time, period) for m in mechanisms if isinstance(m, Pressure)), still)  # type: ignore[arg-type]
            for atrium in ATRIA
        ]
        return np.array([self.left_atrium + added[0], self.right_atrium + added[1]])


class Network:
    """The branches of a circulation with its mechanisms: valves first, then whatever leaks."""

    def __init__(self, circulation: Circulation, mechanisms: Sequence[Mechanism]) -> None:
        self._valves = [getattr(circulation, name).law() for name in VALVES]
        self._leaks = [m for m in mechanisms if isinstance(m, Flow)]
        self.names = [*VALVES, *(type(leak).__name__ for leak in self._leaks)]
        ends = [*VALVES.values(), *((leak.upstream, leak.downstream) for leak in self._leaks)]
        self.ends = np.array([[COMPARTMENTS.index(end) for end in pair] for pair in ends])

    def laws(self, time: Floats | float) -> Floats:
        """Coefficients (branches, 4, ...) of the branches at ``time`` (...); see :class:`~heartfit.branch.Branch`."""
        time = np.asarray(time)
        laws = [*self._valves, *(leak.law(time) for leak in self._leaks)]
        return np.array([[np.broadcast_to(each, time.shape) for each in law] for law in laws])


class NetworkStep:
    """Flows of one step as functions of the unknown pressures (4,) at its end."""

    def __init__(
        self, circulation: Circulation, mechanisms: Sequence[Mechanism], time: float, dt: float, period: float
    ) -> None:
        self._circulation, self._network = circulation, Network(circulation, mechanisms)
        self.dt = dt
        self.atrial = circulation.atrial(time, period, mechanisms)
        self._laws = self._network.laws(time)

    def flows(self, pressures: Floats) -> dict[str, float]:
        """Flow of every branch by name."""
        p = np.concatenate([pressures, self.atrial])
        drops = p[self._network.ends[:, 0]] - p[self._network.ends[:, 1]]
        named = zip(self._network.names, self._laws, drops, strict=True)
        return {name: branch_flow(law, drop)[0] for name, law, drop in named}

    def outflow(self, pressures: Floats) -> tuple[Floats, Floats]:
        """Net outflow (4,) of the unknown compartments and its Jacobian (4, 4)."""
        out, slope = net_outflow(self._laws, self._network.ends, np.concatenate([pressures, self.atrial]))
        return out[:4], slope[:4, :4]

    def windkessels(self, trees: Sequence[WindkesselState]) -> Floats:
        """Rows (a, b) of the arterial pressures a + b q at the end of the step, aorta first."""
        sides = zip(self._circulation.trees(), trees, strict=True)
        return np.array([tree.affine(held, self.dt) for tree, held in sides])

    def advance(
        self, trees: Sequence[WindkesselState], pressures: Floats
    ) -> tuple[WindkesselState, WindkesselState]:
        """States of the Windkessels at the end of the step, given the pressures there."""
        out, _ = self.outflow(pressures)
        systemic, pulmonary = self._circulation.trees()
        return systemic.advance(trees[0], -out[2], self.dt), pulmonary.advance(trees[1], -out[3], self.dt)


@njit(cache=True, error_model="numpy")
def net_outflow(laws, ends, p):  # type: ignore[no-untyped-def]
    """Net outflow (6,) of all compartments at the pressures p (6,), and its Jacobian (6, 6)."""
    out, slope = np.zeros(6), np.zeros((6, 6))
    for branch in range(ends.shape[0]):
        i, j = ends[branch]
        q, dq = branch_flow(laws[branch], p[i] - p[j])
        out[i] += q
        out[j] -= q
        slope[i, i] += dq
        slope[i, j] -= dq
        slope[j, j] += dq
        slope[j, i] -= dq
    return out, slope
