r"""Energy balance of the blood of a beat between atria, walls, valves and arteries, from its states alone.

Atria and walls work on the blood, which gives work to the arteries, loses energy in the valves and stores it as kinetic
energy in them:

.. math:: \sum_a \int p_a\, q_a\, dt - \sum_c \int P_c\, dV_c = \sum_d \int p_d\, q_d\, dt
          + \sum_v \int q_v x_v\, dt + \Delta \sum_v \tfrac12 L_v q_v^2 + \text{remainder}

with the flows :math:`q_a` out of the atria a and :math:`q_d` into the arteries d. The pressure :math:`x_v` that the
valve v loses at its flow and opening follows from its law, :math:`q = f_\zeta(x)`, not from the pressures on its sides,
:math:`x = \Delta p - L \dot q`. The remainder is the error in time. All energies are in joules.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

from heartfit.core.arrays import Floats
from heartfit.heart.circulation.network import Network
from heartfit.heart.circulation.state import HeartState
from heartfit.heart.heart import Heart
from heartfit.roles import COMPARTMENTS
from heartfit.roles.laws import NO_LEAFLETS, instant_flow

LARGEST_LOSS = 1e6
"""Bound of the pressure that a valve loses [Pa]."""


@dataclass(frozen=True)
class BloodAudit:
    """Energies [J]: work of atria and walls on the blood, work that the arteries take, losses by valve.

    ``kinetic`` is the kinetic energy of the blood in the valves at the end less that at the start.
    """

    atria: float
    walls: float
    arteries: float
    lost: dict[str, float]
    kinetic: float

    @property
    def remainder(self) -> float:
        """Work on the blood less the energy that it gives away, loses and stores [J]."""
        return self.atria + self.walls - self.arteries - sum(self.lost.values()) - self.kinetic


def audit_blood(heart: Heart, history: Sequence[HeartState], time_step: float) -> BloodAudit:
    """Audit the states of ``heart`` at the start of its first beat and after steps of the length ``time_step`` [s]."""
    network = Network(heart.circulation, heart.mechanisms)
    times: Floats = time_step * np.arange(len(history), dtype=np.float64)
    flows, openings = (np.array([_branches(state, network)[row] for state in history]) for row in (0, 1))
    atria = heart.circulation.atrial(times, heart.period, heart.mechanisms).T
    pressures = np.hstack([[state.pressures for state in history], atria])
    volumes = np.array([state.volumes for state in history])
    lost = flows * _lost_pressures(network, times, flows, openings)
    kinetic = 0.5 * flows**2 @ network.leaflets[:, 0]
    means = 0.5 * (pressures[1:, :2] + pressures[:-1, :2])
    work = _integral(pressures * (flows @ _incidence(network)), times)
    return BloodAudit(
        atria=float(work[4:].sum()),
        walls=-float(np.sum(means * np.diff(volumes, axis=0))),
        arteries=-float(work[2:4].sum()),
        lost=dict(zip(network.names, _integral(lost, times).tolist(), strict=True)),
        kinetic=float(kinetic[-1] - kinetic[0]),
    )


def _incidence(network: Network) -> Floats:
    """Outflow (k, 6) of the compartments for a unit flow in each branch."""
    compartments = np.eye(len(COMPARTMENTS))
    upstream, downstream = network.ends.T
    result: Floats = compartments[upstream] - compartments[downstream]
    return result


def _branches(state: HeartState, network: Network) -> Floats:
    """Flows and openings (2, k) of a state; zero at rest."""
    return np.zeros((2, len(network.names))) if state.branches is None else state.branches


def _integral(rates: Floats, times: Floats) -> Floats:
    return np.atleast_1d(np.trapezoid(rates, times, axis=0))


def _lost_pressures(network: Network, times: Floats, flows: Floats, openings: Floats) -> Floats:
    """Pressures (t, k) [Pa] that the branches lose at their flows and openings (t, k)."""
    laws, lost = network.laws(times), np.zeros_like(flows)
    moving = network.leaflets[:, 2] > 0.0
    for (t, k), flow in np.ndenumerate(flows):
        if flow:
            zeta = float(openings[t, k]) if moving[k] else NO_LEAFLETS
            lost[t, k] = _lost_pressure(laws, t, k, zeta, flow)
    return lost


def _lost_pressure(laws: Floats, t: int, k: int, zeta: float, flow: float) -> float:
    """Pressure x at which branch k of the ``laws`` (t, k, 5) has the flow [m^3/s]: its law increases with x."""

    def excess(x: float) -> float:
        return float(instant_flow(laws, t, k, x, zeta)[0] / flow - 1.0)

    return float(brentq(excess, 0.0, np.copysign(LARGEST_LOSS, flow), xtol=1e-9))
