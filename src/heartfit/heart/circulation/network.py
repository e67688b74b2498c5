r"""Network of the circulation: compartments connected by branches.

Ventricles store blood, :math:`\dot V = \sum q_{in} - \sum q_{out}`; arteries respond to their inflow as a Windkessel;
atria have a prescribed pressure, or a volume (:mod:`heartfit.heart.circulation.atria`). Every flow leaves one
compartment and enters another, so blood is conserved by construction.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numba import njit
from numpy.typing import NDArray

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter
from heartfit.heart.circulation.atria import chamber_table, drain_arteries, end_atrium, sides_filling_veins
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
from heartfit.roles.chamber import (
    ACTIVE,
    OUTSIDE,
    RESISTANCE,
    START_VEIN,
    START_VOLUME,
    STIFFENING,
    VEIN_END,
    VOLUME,
)
from heartfit.roles.laws import (
    CLOSING_RATE,
    FLOW,
    INERTIA,
    OPENING,
    OPENING_RATE,
    START_FLOW,
    STATE_ROWS,
    Branch,
    Leaflets,
    advance_branch,
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
    """Contraction e (...) of the atria and pressures (sides, ...) [Pa] beside it at ``time`` (...) [s].

    They act on atria with a volume, of which the first replaces the pressure of the contraction.
    """
    contraction = np.zeros(np.shape(time))
    for kick in (m for m in mechanisms if isinstance(m, Contraction)):
        contraction += kick.contraction(time, period)  # type: ignore[arg-type]
    others = [m for m in mechanisms if not isinstance(m, Contraction)]
    return contraction, mechanism_pressures(ATRIA[:sides], time, period, others)


class Network:
    """Branches of a circulation with its mechanisms: the valves, narrowed where they are stenosed, then the leaks.

    With ``sides`` = 1 these are the branches among the compartments of the left heart.
    """

    def __init__(self, circulation: Circulation, mechanisms: Sequence[Mechanism], sides: int = 2) -> None:
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

    def laws(self, time: Floats | float) -> Floats:
        """Coefficients (..., branches, 6) of the branches at ``time`` (...) [s]; see ``Branch``."""
        time = np.asarray(time)
        laws = [*self._valves, *(leak.law(time) for leak in self._leaks)]
        result = np.empty((*time.shape, len(laws), len(Branch._fields)))
        for k, law in enumerate(laws):
            for c, coefficient in enumerate(law):
                result[..., k, c] = coefficient
        return result


class NetworkStep:
    """Flows at the end of one step as functions of the n unknown pressures: 4, or 6 where an atrium has a volume.

    ``dt`` [s] is the effective length of the step, ``start`` (2, k) are the starting values of flow and opening of the
    branches, zero without any; ``atrial_start`` (2, 2) those of the volumes [m^3] of the atria and of the pressures
    [Pa] of the veins. Steps may share a ``network``, that of their circulation and mechanisms.
    """

    def __init__(
        self,
        circulation: Circulation,
        mechanisms: Sequence[Mechanism],
        time: float,
        dt: float,
        period: float,
        start: Floats | None = None,
        atrial_start: Floats | None = None,
        network: Network | None = None,
    ) -> None:
        network = network or Network(circulation, mechanisms)
        self._circulation = circulation
        self.dt, self._names = dt, network.names
        self.atrial = circulation.atrial(time, period, mechanisms)
        self._arterial = mechanism_pressures(ARTERIES, time, period, mechanisms)
        self.ends, self.laws = network.ends, network.laws(time)[None]
        self.branch_states = np.zeros((STATE_ROWS, len(self.ends)))
        self.branch_states[INERTIA] = network.leaflets[:, 0] / dt
        self.branch_states[OPENING_RATE : CLOSING_RATE + 1] = network.leaflets[:, 1:].T * dt
        if start is not None:
            self.branch_states[START_FLOW : START_FLOW + 2] = start
        self._stateful = network.leaflets.any(axis=1)
        self.atria = None if network.atria is None else network.atria.copy()
        if self.atria is not None:
            contraction, self.atria[OUTSIDE] = atrial_walls(time, period, mechanisms)
            self.atria[STIFFENING] = contraction * self.atria[ACTIVE]
            self.atria[[START_VOLUME, START_VEIN]] = 0.0 if atrial_start is None else atrial_start

    def flows(self, pressures: Floats, states: Floats | None = None) -> dict[str, float]:
        """Flow of every branch by name [m^3/s]; those with a state have the flow of ``states`` (2, k)."""
        self.outflow(pressures)
        flows = (
            self.branch_states[FLOW]
            if states is None
            else np.where(self._stateful, states[0], self.branch_states[FLOW])
        )
        return dict(zip(self._names, flows.tolist(), strict=True))

    @property
    def stores_blood(self) -> NDArray[np.bool_]:
        """True (n,) for ventricles and atria with a volume, whose equation is the balance of their blood."""
        return np.array(
            [True, True, False, False, *(() if self.atria is None else self.atria[RESISTANCE] > 0.0)]
        )

    def outflow(self, pressures: Floats) -> tuple[Floats, Floats]:
        """Net outflow (n,) of the unknown compartments [m^3/s] and its Jacobian (n, n)."""
        n = len(pressures)
        out, slope = np.empty((1, n)), np.empty((n, n))
        net_outflow(self.ends, self.laws, self.branch_states, self.atrial[None], 0, pressures, out, slope)
        return out[0], slope

    def windkessels(self, trees: Sequence[WindkesselState]) -> Floats:
        """Rows (a, b, c) of the arterial pressures a + b q + c P at the end of the step, aorta first.

        P is the pressure of the atrium whose veins they fill.
        """
        sides = zip(self.trees(), trees, strict=True)
        rows = np.zeros((2, 3))
        for u, (tree, state) in enumerate(sides):
            held = tree.affine_pressure(state, self.dt)
            constants = self.dt, tree.R_p, tree.tau, state.P_c
            rows[u] = drain_arteries(self.atria, u, *constants, *held, self._arterial[u])
        rows[:, 0] += self._arterial
        return rows

    def trees(self) -> list[Windkessel]:
        """Windkessels, with a venous pressure of zero where they fill veins: that of the veins is added to it."""
        filling = sides_filling_veins(self.atria)
        trees = enumerate(self._circulation.trees())
        return [replace(tree, P_ve=0.0) if u in filling else tree for u, tree in trees]

    def branches(self) -> Floats:
        """Flows and openings (2, k) at the pressures of the last evaluation."""
        return self.branch_states[FLOW : OPENING + 1].copy()

    def advance(
        self, trees: Sequence[WindkesselState], pressures: Floats
    ) -> tuple[WindkesselState, WindkesselState]:
        """States of the Windkessels at the end of the step, at which the pressures are ``pressures`` (n,)."""
        out, _ = self.outflow(pressures)
        systemic, pulmonary = self._drained(out, pressures)
        return systemic.advance(trees[0], -out[2], self.dt), pulmonary.advance(trees[1], -out[3], self.dt)

    def _drained(self, out: Floats, pressures: Floats) -> Sequence[Windkessel]:
        """Windkessels with the venous pressures at the end of the step, and the volumes of the atria there."""
        trees: list[Windkessel] = list(self._circulation.trees())
        if self.atria is not None:
            for s in range(2):
                end_atrium(self.atria, s, self.dt, -out[3 - s], out[4 + s], pressures[4 + s])
            for u in sides_filling_veins(self.atria):
                trees[u] = replace(trees[u], P_ve=float(self.atria[VEIN_END, 1 - u]))
        return trees

    def atrial_state(self) -> Floats | None:
        """Volumes [m^3] of the atria and pressures [Pa] of their veins (2, 2) at the end; None without volumes."""
        return None if self.atria is None else self.atria[[VOLUME, VEIN_END]]


@njit(cache=True, error_model="numpy", inline="always")
def net_outflow(ends, laws, branch_states, atria, t, p, out, slope):  # type: ignore[no-untyped-def]
    """Fill row 0 of ``out`` with the net outflow (n,) of v ventricles and their arteries, and its Jacobian ``slope``.

    p (n,) are their pressures, n = 2 v, followed by those of the atria, n = 3 v, if one of them has a volume;
    ``atria`` (t, v) and ``laws`` (t, k, 6) are the prescribed atrial pressures and the coefficients of the branches
    with the ``ends`` (k, 2) at many times, of which row t applies. ``branch_states`` (7, k) has the rows of
    :mod:`heartfit.roles.laws`; those at the end of the step are filled.
    """
    n, v = p.size, atria.shape[1]
    for i in range(n):
        out[0, i] = 0.0
        for j in range(n):
            slope[i, j] = 0.0
    for k in range(ends.shape[0]):
        upstream, downstream = ends[k, 0], ends[k, 1]
        i, j = _unknown(upstream, v, n), _unknown(downstream, v, n)
        up = p[i] if i >= 0 else atria[t, upstream - 4]
        down = p[j] if j >= 0 else atria[t, downstream - 4]
        q, dq = advance_branch(laws, t, k, up - down, branch_states)
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
def _unknown(compartment, v, n):  # type: ignore[no-untyped-def]
    """Index of a compartment among the n unknown pressures; -1 for an atrium of prescribed pressure."""
    if compartment < 2:
        return compartment
    if compartment < 4:
        return v + compartment - 2
    return 2 * v + compartment - 4 if n > 2 * v else -1
