r"""The circuit around the ventricles: compartments joined by branches.

Ventricles keep their blood, :math:`\dot V = \sum q_{in} - \sum q_{out}`; arteries answer their inflow with a
Windkessel; atria have a prescribed pressure. Flow leaves one compartment and enters another, so blood is
conserved by construction.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

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

    def atrial(self, time: float, period: float, mechanisms: Sequence[Mechanism]) -> Floats:
        """Pressures (2,) of the left and right atrium."""
        added = [
            sum(m.pressure(atrium, time, period) for m in mechanisms if isinstance(m, Pressure))
            for atrium in ATRIA
        ]
        return np.array([self.left_atrium, self.right_atrium]) + added


class NetworkStep:
    """Flows of one step as functions of the unknown pressures (4,) at its end."""

    def __init__(
        self, circulation: Circulation, mechanisms: Sequence[Mechanism], time: float, dt: float, period: float
    ) -> None:
        self._circulation, self._time = circulation, time
        self.dt = dt
        self.atrial = circulation.atrial(time, period, mechanisms)
        self._leaks = [m for m in mechanisms if isinstance(m, Flow)]

    def flows(self, pressures: Floats) -> list[tuple[str, int, int, float, float]]:
        """Name, upstream and downstream compartment, flow and slope of every branch."""
        p = [*pressures, *self.atrial]
        branches = []
        for name, ends in VALVES.items():
            i, j = COMPARTMENTS.index(ends[0]), COMPARTMENTS.index(ends[1])
            branches.append((name, i, j, *getattr(self._circulation, name).flow(p[i] - p[j])))
        for leak in self._leaks:
            i, j = COMPARTMENTS.index(leak.upstream), COMPARTMENTS.index(leak.downstream)
            branches.append((type(leak).__name__, i, j, *leak.flow(self._time, p[i] - p[j])))
        return branches

    def outflow(self, pressures: Floats) -> tuple[Floats, Floats]:
        """Net outflow (4,) of the unknown compartments and its Jacobian (4, 4)."""
        out, slope = np.zeros(6), np.zeros((6, 6))
        for _, i, j, q, dq in self.flows(pressures):
            out[i] += q
            out[j] -= q
            slope[i, i] += dq
            slope[i, j] -= dq
            slope[j, j] += dq
            slope[j, i] -= dq
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
