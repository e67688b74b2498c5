r"""Energy and volume balances of a beat, from its states alone.

Without inertia the power of the cavity pressures is that of the internal forces, so over any time

.. math:: \sum_c \int P_c\, dV_c + W_{bridges} = \Delta U + D + \text{remainder}

U is stored in the matrix (shape and volume), the supports, the series springs (:math:`E_s e_s^2/2`) and the bridges
(:math:`\tau_c^2/2k_c`); D is dissipated by the matrix (:math:`\eta \dot E : \dot E`), the dampers of the rings, the
friction in the sarcomere (:math:`\mu(k_c)\, \dot e_c^2`) and the destruction of bridges,
:math:`(|u| + \alpha |\dot e_c|)\, \tau_c^2/2k_c`; the bridges that attach bring

.. math:: \dot W_{bridges} = n_0 |u|_+ \Big(\sigma_0 \frac{\tau_c}{k_c} - \frac{k_0}{2} \frac{\tau_c^2}{k_c^2}\Big).

The remainder is the error in time. The fibres do not contribute to it: their scheme balances energy in every step. All
energies are in joules, of Mooney-Rivlin tissue.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.heart.beat import Beat
from heartfit.heart.circulation.network import Network
from heartfit.heart.circulation.network_step import NetworkStep
from heartfit.heart.circulation.state import HeartState
from heartfit.heart.finite_elements.body import BodyState, FiniteElementBody
from heartfit.heart.finite_elements.elements import CONSISTENT_MASS, PROJECTION_DEFECT
from heartfit.heart.finite_elements.kinematics import VOIGT, fibre_strain
from heartfit.heart.heart import Heart
from heartfit.heart.time_step import TimeStep

SHEAR_TWICE = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])


@dataclass(frozen=True)
class Audit:
    """Energies of a beat by name [J]: work of the cavities, supplied, stored (end less start) and dissipated.

    fibre_gap: work on the fibres less the energy that they store and dissipate, plus their supply.
    """

    work: dict[str, float]
    supplied: float
    stored: dict[str, float]
    dissipated: dict[str, float]
    fibre_gap: float

    @property
    def remainder(self) -> float:
        """Supplied energy less work, stored and dissipated energy [J]."""
        kept_or_lost = sum(self.stored.values()) + sum(self.dissipated.values())
        return self.supplied - self.ejecting - kept_or_lost

    @property
    def ejecting(self) -> float:
        """Work of the wall on the blood [J], the scale of the remainder."""
        return -sum(self.work.values())


def audit(
    body: FiniteElementBody, history: Sequence[HeartState], period: float, second_order: bool = True
) -> Audit:
    """Audit the states of a beat at equidistant times, computed by a scheme of this order."""
    steps, dt = list(pairwise(history)), period / (len(history) - 1)
    work = sum(
        (0.5 * (a.pressures + b.pressures)[:2] * (b.volumes - a.volumes) for a, b in steps), np.zeros(2)
    )
    first, last = (energies(body, history[i].body) for i in (0, -1))
    stored = {name: last[name] - first[name] for name in first}
    times = [TimeStep(n * dt, dt, period, second_order) for n in range(len(steps))]
    flows = [_fibres(body, a.body, b.body, step) for (a, b), step in zip(steps, times, strict=True)]
    on_fibres, supplied, friction, destruction = np.sum(flows, axis=0)
    lost = np.sum([_losses(body, a.body, b.body, dt) for a, b in steps], axis=0)
    dissipated = dict(zip(("matrix", "rings"), lost.tolist(), strict=True))
    dissipated |= {"friction": float(friction), "destruction": float(destruction)}
    kept = stored["springs"] + stored["bridges"] + friction + destruction - supplied
    sides = dict(zip(("lv", "rv"), work.tolist(), strict=True))
    return Audit(sides, float(supplied), stored, dissipated, float(on_fibres - kept))


def energies(body: FiniteElementBody, state: BodyState) -> dict[str, float]:
    """Stored energies of a state by name [J]."""
    u, weights = state.x[:, :3], body.element_volumes
    e = fibre_strain(state.C, body.dyads)
    spring = (e - state.fibres[0]) / (1.0 + 2.0 * state.fibres[0])
    return {
        "shape": float(weights @ (body.passive_scale * _mooney_rivlin(body, state.C))),
        "volume": float(weights @ _volumetric(body, state)),
        "supports": float(0.5 * np.einsum("ni,nij,nj->", u, body.stiffness, u)),
        "springs": float(weights @ (0.5 * body.tissue.active.E_s * spring**2)),
        "bridges": float(weights @ (0.5 * state.fibres[2] ** 2)),
    }


def _mooney_rivlin(body: FiniteElementBody, C: Floats) -> Floats:
    full = C[:, VOIGT]
    cube_root = np.cbrt(np.linalg.det(full))  # J^(2/3)
    first = np.trace(full, axis1=1, axis2=2)
    second = 0.5 * (first**2 - np.einsum("eij,eji->e", full, full))
    law = body.tissue.passive
    energy: Floats = law.c_1 * (first / cube_root - 3.0) + law.c_2 * (second / cube_root**2 - 3.0)  # type: ignore[attr-defined]
    return energy


def _volumetric(body: FiniteElementBody, state: BodyState) -> Floats:
    """Volumetric energy K (J - 1)^2 / 2, or p (J - 1) - p C p / 2 of the mixed element."""
    K, G = body.tissue.passive.K, body.tissue.passive.shear_modulus
    growth = np.sqrt(np.linalg.det(state.C[:, VOIGT])) - 1.0
    if body.element.dofs == 3:
        squeezed: Floats = 0.5 * K * growth**2
        return squeezed
    p = state.x[body.tets, 3]
    compliance = CONSISTENT_MASS / K + PROJECTION_DEFECT / G
    mixed: Floats = p.mean(axis=1) * growth - 0.5 * np.einsum("ea,ab,eb->e", p, compliance, p)
    return mixed


def _losses(body: FiniteElementBody, a: BodyState, b: BodyState, dt: float) -> tuple[float, float]:
    """Energies that matrix and ring dampers dissipate in one step [J]."""
    strain = 0.5 * (b.C - a.C)
    motion = (b.x - a.x)[:, :3]
    matrix = body.tissue.passive.eta / dt * body.element_volumes @ (strain**2 @ SHEAR_TWICE)
    return float(matrix), float(np.einsum("ni,nij,nj->", motion, body.damping, motion) / dt)


def _fibres(body: FiniteElementBody, a: BodyState, b: BodyState, step: TimeStep) -> tuple[float, ...]:
    """Energies of one step [J]: work on the fibres, supply by attaching bridges, friction, destruction of bridges."""
    active, V, dt = body.tissue.active, body.element_volumes, step.length
    drive = active.drive(
        step, body.tissue.control.mean(step.start, dt, body.activation, step.period), a.fibres
    )
    d, mean = b.fibres[0] - a.fibres[0], 0.5 * (a.fibres[2] + b.fibres[2])
    old, new = np.sqrt(a.fibres[1]), np.sqrt(b.fibres[1])
    root = 0.5 * (old + new) if step.second_order else new
    extension = mean / root
    attached = dt * drive.n_0 * drive.attach * (active.sigma_0 * extension - 0.5 * active.k_0 * extension**2)
    broken = 0.5 * (dt * drive.rate + active.alpha * np.abs(d)) * mean**2
    stretched = fibre_strain(b.C, body.dyads) - fibre_strain(a.C, body.dyads)
    terms = (b.stress * stretched, attached, active.friction(root**2) * d**2 / dt, broken)
    return tuple(float(V @ term) for term in terms)


VALVES = {"lv": ("mitral", "aortic"), "rv": ("tricuspid", "pulmonary")}


def lost_blood(heart: Heart, history: Sequence[HeartState], second_order: bool = True) -> Floats:
    """Volume that ventricles and arterial trees (4,) gained less their net inflow [m^3], over a first beat from rest.

    Flows are evaluated at the ends of the steps; their means over a step follow the time scheme,
    q# = (q + b q#_before) / (1 + b), with b = 0 in the first step.
    """
    dt, total, mean = heart.period / (len(history) - 1), np.zeros(4), np.zeros(4)
    for n, (before, state) in enumerate(pairwise(history)):
        step = TimeStep(n * dt, dt, heart.period, second_order, before.last)
        mean = (_outflow(heart, before, state, step) + step.memory * mean) / (1.0 + step.memory)
        total += dt * mean
    return _contents(heart, history[-1]) - _contents(heart, history[0]) + total


def _outflow(heart: Heart, before: HeartState, state: HeartState, step: TimeStep) -> Floats:
    """Outflow of the ventricles, and of the arteries through valves and periphery (4,) [m^3/s]."""
    start = before.starting_branches(step)
    branches = Network(heart.circulation, heart.mechanisms)
    network = NetworkStep(branches, step.end, step.effective, heart.period, start)
    sides = zip(heart.circulation.trees(), state.trees, strict=True)
    periphery = [(state_of_tree.P_c - tree.P_ve) / tree.R_p for tree, state_of_tree in sides]
    flow: Floats = network.outflow(state.pressures)[0] + [0.0, 0.0, *periphery]
    return flow


def _contents(heart: Heart, state: HeartState) -> Floats:
    sides = zip(heart.circulation.trees(), state.trees, strict=True)
    return np.array(
        [*state.volumes, *(tree.tau / tree.R_p * state_of_tree.P_c for tree, state_of_tree in sides)]
    )


def isovolumic_drift(beat: Beat) -> float:
    """Largest change of a ventricular volume in a phase with both valves closed [m^3]."""
    return max(_drift(beat, side, *valves) for side, valves in VALVES.items())


def _drift(beat: Beat, side: str, inlet: str, outlet: str) -> float:
    closed = (beat.flow[inlet] <= 0.0) & (beat.flow[outlet] <= 0.0)
    steps = np.flatnonzero(closed[1:] & closed[:-1])
    phases = np.split(steps, np.flatnonzero(np.diff(steps) > 1) + 1)
    volume = beat.volume[side]
    return max((float(abs(volume[p[-1] + 1] - volume[p[0]])) for p in phases if p.size), default=0.0)
