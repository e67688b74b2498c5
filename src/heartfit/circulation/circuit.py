r"""The circuit of one step, the ventricles being replaced by their linear response to pressure.

Unknown are the pressures p of v ventricles and their arteries:

.. math:: v + G (p_v - p_v^0) + \Delta t\, q_v(p) = 0, \qquad p_a - a + b\, q_a(p) = 0,

with v the change of the ventricular volumes since the start of the step at :math:`p^0`, G their compliance,
q the net outflow of the compartments and (a, b) the Windkessels. The equations are monotone but kinked by the
valves: Newton's method with a line search. One compiled function solves the circuits of meshes and of spheres.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit

from heartfit.circulation.network import NetworkStep, net_outflow
from heartfit.geometry.arrays import Floats, Integers

ONE_MILLILITRE, ONE_KILOPASCAL = 1e-6, 1e3
"""What counts as one in the residual."""

ITERATIONS, HALVINGS, TOLERANCE = 40, 10, 1e-9

GAP, WEIGHT, ABOUT, STORED = range(4)
"""Columns of a system: residual = gap + weight times net outflow + stored (p - about), rows as the pressures."""

RESIDUAL, MOVE, OLD = range(3)
"""Rows of the room that the solution takes."""


@dataclass(frozen=True, eq=False)
class Circuit:
    """Equations of the condensed circuit of both ventricles; see the module."""

    network: NetworkStep
    windkessels: Floats
    volume_change: Floats
    compliance: Floats
    start: Floats

    def solve(self) -> Floats:
        """Pressures (4,) that balance the circuit; the best found if the line search ends before that."""
        p = self.start.copy()
        solve_circuit(*self._branches(), self._system(), p, np.empty((3, 4)), np.empty((4, 4)))
        return p

    def gaps(self, p: Floats) -> Floats:
        """Residual (4,) at the pressures p: m^3 for the ventricles, Pa for the arteries."""
        room = np.empty((3, 4))
        circuit_residual(*self._branches(), self._system(), p, room, np.empty((4, 4)))
        return room[RESIDUAL] * np.repeat([ONE_MILLILITRE, ONE_KILOPASCAL], 2)

    def _branches(self) -> tuple[Integers, Floats, Floats, Floats, int]:
        network = self.network
        return network.ends, network.laws, network.moving, network.atrial[None], 0

    def _system(self) -> Floats:
        system = np.zeros((4, 7))
        a, b = self.windkessels.T
        system[:2, GAP], system[:2, WEIGHT] = self.volume_change, self.network.dt
        system[:2, ABOUT], system[:2, STORED : STORED + 2] = self.start[:2], self.compliance
        system[2:, WEIGHT], system[2:, ABOUT], system[2:, STORED + 2 :] = b, a, np.eye(2)
        system[:, [GAP, WEIGHT, *range(STORED, 7)]] /= np.repeat([ONE_MILLILITRE, ONE_KILOPASCAL], 2)[:, None]
        return system


@njit(cache=True, error_model="numpy", inline="always")
def circuit_residual(ends, laws, moving, atria, t, system, p, room, jacobian):  # type: ignore[no-untyped-def]
    """Fill residual and Jacobian at the pressures p (2 v,); the norm of the residual."""
    net_outflow(ends, laws, moving, atria, t, p, room, jacobian)
    size = 0.0
    for i in range(p.size):
        gap = system[i, GAP] + system[i, WEIGHT] * room[RESIDUAL, i]
        for j in range(p.size):
            stored = system[i, STORED + j]
            gap += stored * (p[j] - system[j, ABOUT])
            jacobian[i, j] = stored + system[i, WEIGHT] * jacobian[i, j]
        room[RESIDUAL, i] = gap
        size += gap * gap
    return np.sqrt(size)


@njit(cache=True, error_model="numpy", inline="always")
def solve_circuit(ends, laws, moving, atria, t, system, p, room, jacobian):  # type: ignore[no-untyped-def]
    """Move p (2 v,) to the balance of the circuit; the norm of the residual where p was.

    Branches as in :func:`~heartfit.circulation.network.net_outflow`, ``system`` (2 v, 3 + 2 v) as the module's
    columns say; ``room`` (3, 2 v), whose rows the module names, and ``jacobian`` (2 v, 2 v) are overwritten.
    """
    size = first = circuit_residual(ends, laws, moving, atria, t, system, p, room, jacobian)
    for _ in range(ITERATIONS):
        if size < TOLERANCE:
            break
        eliminate(jacobian, room)
        for i in range(p.size):
            room[MOVE, i], room[OLD, i] = room[RESIDUAL, i], p[i]
        share, following = 1.0, np.inf
        for _ in range(HALVINGS):
            for i in range(p.size):
                p[i] = room[OLD, i] - share * room[MOVE, i]
            following = circuit_residual(ends, laws, moving, atria, t, system, p, room, jacobian)
            if following < size:
                break
            share *= 0.5
        size = following
    return first


@njit(cache=True, error_model="numpy", inline="always")
def eliminate(matrix, room):  # type: ignore[no-untyped-def]
    """Solve in place for the residual, by elimination with row pivots."""
    n = matrix.shape[0]
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > abs(matrix[best, k]):
                best = i
        if best != k:
            for j in range(k, n):
                matrix[k, j], matrix[best, j] = matrix[best, j], matrix[k, j]
            room[RESIDUAL, k], room[RESIDUAL, best] = room[RESIDUAL, best], room[RESIDUAL, k]
        for i in range(k + 1, n):
            factor = matrix[i, k] / matrix[k, k]
            for j in range(k, n):
                matrix[i, j] -= factor * matrix[k, j]
            room[RESIDUAL, i] -= factor * room[RESIDUAL, k]
    for k in range(n - 1, -1, -1):
        for j in range(k + 1, n):
            room[RESIDUAL, k] -= matrix[k, j] * room[RESIDUAL, j]
        room[RESIDUAL, k] /= matrix[k, k]
