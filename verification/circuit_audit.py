r"""Energy balance of the blood over a beat on its limit cycle, from its states alone.

The walls do the work :math:`-\oint P\, dV` on the blood of a ventricle. On that of an atrium it has a part of the
passive wall, zero over a cycle, one of the contraction, :math:`-\oint e E_{act} (x - V_0)\, dx`, and one of the descent
of the valve plane, :math:`\kappa \oint P\, dV_v`. Reservoirs bring :math:`P_v \int q_v dt`, and the arteries of an open
circuit leave :math:`P_{ve} \int (P_c - P_{ve})/R_p\, dt`. All of it is lost: in valves and leaks
:math:`\int q \Delta p\, dt`, in arteries :math:`\int Z_c (q - q_L)^2 + (P_c - P_{ve})^2 / R_p\, dt`, and in veins
:math:`\int R_v q_v^2 dt`. The remainder is the error in time and the departure from the limit cycle. Energies are in
joules.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.circulation.atria import chamber_table, sides_filling_veins, sides_with_volume
from heartfit.heart.circulation.network import Network, atrial_walls
from heartfit.heart.circulation.state import HeartState
from heartfit.heart.heart import Heart
from heartfit.roles.chamber import ACTIVE, DESCENT, RESISTANCE, UNSTRESSED, VENTRICLE


@dataclass(frozen=True)
class CircuitAudit:
    """Energies of a beat by name [J]: ``supplied`` to the blood, and ``lost`` by it."""

    supplied: dict[str, float]
    lost: dict[str, float]

    @property
    def remainder(self) -> float:
        """Supplied less lost energy [J]."""
        return sum(self.supplied.values()) - sum(self.lost.values())


def audit_circuit(heart: Heart, history: Sequence[HeartState]) -> CircuitAudit:
    """Audit of the states of a beat at equidistant times, in a heart both of whose atria have a volume."""
    return _CircuitHistory(heart, history).audit()


class _CircuitHistory:
    """Curves (t, ...) of a beat."""

    def __init__(self, heart: Heart, history: Sequence[HeartState]) -> None:
        table = chamber_table(heart.mechanisms)
        if table is None or len(sides_with_volume(table)) < 2:
            raise ValueError("audit: an atrium has no volume; expected LeftAtrium and RightAtrium")
        self.heart, self.table = heart, table
        self.times: Floats = np.linspace(0.0, heart.period, len(history))
        self.network = Network(heart.circulation, heart.mechanisms)
        atria = np.array([state.atria for state in history])
        self.atria, self.veins = atria[:, 0], atria[:, 1]
        self.ventricles = np.array([state.volumes for state in history])
        self.pressures = np.array([state.pressures for state in history])
        flows = [np.zeros(len(self.network.names)) if s.branches is None else s.branches[0] for s in history]
        self.flows = np.array(flows)
        self.trees = np.array([[(tree.P_c, tree.q_L) for tree in state.trees] for state in history])

    def audit(self) -> CircuitAudit:
        lost = self._branches() | self._arteries()
        lost["veins"] = self._integral(self.table[RESISTANCE] * self._entering() ** 2)
        return CircuitAudit(self._walls() | self._reservoirs(), lost)

    def _walls(self) -> dict[str, float]:
        names, p = ("lv", "rv"), self.pressures
        work = {name: -_work(p[:, v], self.ventricles[:, v]) for v, name in enumerate(names)}
        x = self.atria + self.table[DESCENT] * (self.ventricles - self.table[VENTRICLE])
        contraction, _ = atrial_walls(self.times, self.heart.period, self.heart.mechanisms)
        for s, name in enumerate(("left_atrium", "right_atrium")):
            active = contraction * self.table[ACTIVE, s] * (x[:, s] - self.table[UNSTRESSED, s])
            work[f"{name} active"] = -_work(active, x[:, s])
            work[f"{name} passive"] = -_work(p[:, 4 + s] - active, x[:, s])
            work[f"{name} plane"] = self.table[DESCENT, s] * _work(p[:, 4 + s], self.ventricles[:, s])
        return work

    def _entering(self) -> Floats:
        """Flows (t, 2) from the veins into the atria [m^3/s]."""
        entering: Floats = (self.veins - self.pressures[:, 4:]) / self.table[RESISTANCE]
        return entering

    def _reservoirs(self) -> dict[str, float]:
        """Energy of the blood that enters from reservoirs, and that leaves to the venous pressure of arteries."""
        filled, supply = sides_filling_veins(self.table), 0.0
        for s, tree in enumerate(self.heart.circulation.trees()):
            if 1 - s not in filled:
                supply += self._integral(self.veins[:, s] * self._entering()[:, s])
            if s not in filled:
                supply -= self._integral(tree.P_ve * (self.trees[:, s, 0] - tree.P_ve) / tree.R_p)
        return {"reservoirs": supply}

    def _branches(self) -> dict[str, float]:
        up, down = self.network.ends.T
        drops = self.pressures[:, up] - self.pressures[:, down]
        losses = np.trapezoid(self.flows * drops, self.times, axis=0)
        return dict(zip(self.network.names, losses.tolist(), strict=True))

    def _arteries(self) -> dict[str, float]:
        filled, losses = sides_filling_veins(self.table), {}
        for s, tree in enumerate(self.heart.circulation.trees()):
            venous = self.veins[:, 1 - s] if s in filled else tree.P_ve
            characteristic = (self.pressures[:, 2 + s] - self.trees[:, s, 0]) ** 2 / tree.Z_c
            peripheral = (self.trees[:, s, 0] - venous) ** 2 / tree.R_p
            losses[("aorta", "pulmonary_artery")[s]] = self._integral(characteristic + peripheral)
        return losses

    def _integral(self, power: Floats) -> float:
        return float(np.trapezoid(power, self.times, axis=0).sum())


def _work(pressure: Floats, volume: Floats) -> float:
    return float(np.trapezoid(pressure, volume))
