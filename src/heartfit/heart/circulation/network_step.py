"""Flows of a network at the end of one time step, as functions of the pressures."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numba import njit
from numpy.typing import NDArray

from heartfit.core.arrays import Floats
from heartfit.heart.circulation.atria import drain_arteries, end_atrium, sides_filling_veins
from heartfit.heart.circulation.elements import Windkessel, WindkesselState
from heartfit.heart.circulation.network import Network
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
    advance_branch,
)


class NetworkStep:
    """Flows at the end of one step as functions of the n unknown pressures: 4, or 6 where an atrium has a volume.

    ``dt`` [s] is the effective length of the step, ``start`` (2, k) are the starting values of flow and opening of the
    branches, zero without any; ``atrial_start`` (2, 2) those of the volumes [m^3] of the atria and of the pressures
    [Pa] of the veins.
    """

    def __init__(
        self,
        network: Network,
        time: float,
        dt: float,
        period: float,
        start: Floats | None = None,
        atrial_start: Floats | None = None,
    ) -> None:
        prescribed = network.prescribed(time, period)
        self._circulation = network.circulation
        self.dt, self._names = dt, network.names
        self.atrial, self._arterial = prescribed.atrial, prescribed.arterial
        self.ends, self.laws = network.ends, prescribed.laws[None]
        self.branch_states = np.zeros((STATE_ROWS, len(self.ends)))
        self.branch_states[INERTIA] = network.leaflets[:, 0] / dt
        self.branch_states[OPENING_RATE : CLOSING_RATE + 1] = network.leaflets[:, 1:].T * dt
        if start is not None:
            self.branch_states[START_FLOW : START_FLOW + 2] = start
        self._stateful = network.leaflets.any(axis=1)
        self.atria = None if network.atria is None else network.atria.copy()
        if self.atria is not None and prescribed.walls is not None:
            contraction, self.atria[OUTSIDE] = prescribed.walls
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
