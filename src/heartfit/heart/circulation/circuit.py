r"""Circuit of one time step, with the ventricles condensed to their linear response to pressure.

The unknowns are the pressures p of v ventricles and of their arteries:

.. math:: v + G (p_v - p_v^0) + \Delta t\, q_v(p) = 0, \qquad p_a - a + b\, q_a(p) = 0,

with v the change of the ventricular volumes since the start of the step at :math:`p^0`, G their compliance, q the net
outflow of the compartments and (a, b) the coefficients of the Windkessels. Atria with a volume add their pressures and
the equations of :mod:`heartfit.heart.circulation.atria`. The equations are monotone, with kinks at the valves; Newton's
method with a line search solves them. One compiled function serves meshes and spheres.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats, Integers
from heartfit.heart.circulation.atria import begin_atria, descend_planes, store_blood
from heartfit.heart.circulation.network_step import NetworkStep, net_outflow
from heartfit.heart.circulation.system import (
    CONSTANT,
    ONE_KILOPASCAL,
    ONE_MILLILITRE,
    REFERENCE,
    STORAGE,
    WEIGHT,
)

NEWTON_ITERATIONS, LINE_SEARCH_HALVINGS, RESIDUAL_TOLERANCE = 40, 10, 1e-9

ATRIAL_TOLERANCE = 1e-12
"""Norm of the residual of a circuit whose atria have a volume: a closed one must not create blood over many beats."""

RESIDUAL, DIRECTION, PREVIOUS = range(3)
"""Rows of the workspace of the solution: residual, then Newton direction, and the previous pressures."""


@dataclass(frozen=True, eq=False)
class Circuit:
    """Condensed circuit of both ventricles, see the equations of the module.

    ``windkessels`` (2, 3) are the rows (a, b, c) of the arteries, ``volume_change`` (2,) [m^3] and ``compliance``
    (2, 2) [m^3/Pa] those of the ventricles at the pressures ``start`` (n,) [Pa]; n is 4, or 6 with the atria. The
    descent of the valve planes needs the ``volumes`` (2,) [m^3] of the ventricles at ``start``.
    """

    network: NetworkStep
    windkessels: Floats
    volume_change: Floats
    compliance: Floats
    start: Floats
    volumes: Floats | None = None

    def solve(self) -> Floats:
        """Pressures (n,) [Pa] that balance the circuit; the last ones where the line search fails first."""
        p, n = self.start.copy(), len(self.start)
        solve_circuit(*self._branches(), self._system(), p, np.empty((3, n)), np.empty((n, n)))
        return p

    def residuals(self, p: Floats) -> Floats:
        """Residual (n,) at the pressures p, [m^3] where blood is stored and [Pa] for the arteries."""
        n = len(p)
        work = np.empty((3, n))
        circuit_residual(*self._branches(), self._system(), p, work, np.empty((n, n)))
        return work[RESIDUAL] * np.where(self.network.stores_blood, ONE_MILLILITRE, ONE_KILOPASCAL)

    def _branches(self) -> tuple[Integers, Floats, Floats, Floats | None, Floats, int]:
        network = self.network
        return network.ends, network.laws, network.branch_states, network.atria, network.atrial[None], 0

    def _system(self) -> Floats:
        n = len(self.start)
        system = np.zeros((n, STORAGE + n))
        self._fill_ventricles_and_arteries(system[:4])
        atria = self.network.atria
        if atria is not None:
            system[2, STORAGE + 5], system[3, STORAGE + 4] = -self.windkessels[:, 2] / ONE_KILOPASCAL
            begin_atria(atria, self.network.dt, self.network.atrial[None], 0, system)
            for side, volume in enumerate(self.volumes if self.volumes is not None else ()):
                descend_planes(atria, side, volume, system)
        return system

    def _fill_ventricles_and_arteries(self, system: Floats) -> None:
        ventricles, arteries = system[:2], system[2:]
        ventricles[:, CONSTANT] = self.volume_change / ONE_MILLILITRE
        ventricles[:, WEIGHT] = self.network.dt / ONE_MILLILITRE
        ventricles[:, REFERENCE] = self.start[:2]
        ventricles[:, STORAGE : STORAGE + 2] = self.compliance / ONE_MILLILITRE
        arteries[:, REFERENCE] = self.windkessels[:, 0]
        arteries[:, WEIGHT] = self.windkessels[:, 1] / ONE_KILOPASCAL
        arteries[0, STORAGE + 2] = arteries[1, STORAGE + 3] = 1.0 / ONE_KILOPASCAL


@njit(cache=True, error_model="numpy", inline="always")
def circuit_residual(ends, laws, branch_states, atria, prescribed, t, system, p, work, jacobian):  # type: ignore[no-untyped-def]
    """Fill residual and Jacobian at the pressures p; return the norm of the residual."""
    net_outflow(ends, laws, branch_states, prescribed, t, p, work, jacobian)
    size = 0.0
    for i in range(p.size):
        residual = system[i, CONSTANT] + system[i, WEIGHT] * work[RESIDUAL, i]
        for j in range(p.size):
            storage = system[i, STORAGE + j]
            residual += storage * (p[j] - system[j, REFERENCE])
            jacobian[i, j] = storage + system[i, WEIGHT] * jacobian[i, j]
        if atria is not None:
            stored, slope = store_blood(atria, i, p[i])
            residual += stored
            jacobian[i, i] += slope
        work[RESIDUAL, i] = residual
        size += residual * residual
    return np.sqrt(size)


@njit(cache=True, error_model="numpy", inline="always")
def solve_circuit(ends, laws, branch_states, atria, prescribed, t, system, p, work, jacobian):  # type: ignore[no-untyped-def]
    """Move the pressures p (n,) to the balance of the circuit; return the norm of the residual at the start.

    Branches and ``prescribed`` as in :func:`~heartfit.heart.circulation.network_step.net_outflow`, the table
    ``atria`` of :mod:`heartfit.roles.chamber`, ``system`` (n, 3 + n) with the columns of
    :mod:`heartfit.heart.circulation.system`; ``work`` (3, n), whose rows the module names, and ``jacobian`` (n, n) are
    overwritten.
    """
    for i in range(p.size):
        work[DIRECTION, i], work[PREVIOUS, i] = 0.0, p[i]
    tolerance = RESIDUAL_TOLERANCE
    if atria is not None:
        tolerance = ATRIAL_TOLERANCE
    size = first = np.inf
    for iteration in range(NEWTON_ITERATIONS + 1):
        share, following = 1.0, np.inf
        for _ in range(LINE_SEARCH_HALVINGS):
            for i in range(p.size):
                p[i] = work[PREVIOUS, i] - share * work[DIRECTION, i]
            following = circuit_residual(
                ends, laws, branch_states, atria, prescribed, t, system, p, work, jacobian
            )  # called in one place, as each is inlined
            if following < size:
                break
            share *= 0.5
        size = following
        if iteration == 0:
            first = size
        if size < tolerance or iteration == NEWTON_ITERATIONS:
            break
        solve_linear(jacobian, work)
        for i in range(p.size):
            work[DIRECTION, i], work[PREVIOUS, i] = work[RESIDUAL, i], p[i]
    return first


@njit(cache=True, error_model="numpy", inline="always")
def solve_linear(matrix, work):  # type: ignore[no-untyped-def]
    """Replace the residual row of ``work`` by the solution, by Gaussian elimination with row pivots."""
    n = matrix.shape[0]
    for k in range(n):
        best = k
        for i in range(k + 1, n):
            if abs(matrix[i, k]) > abs(matrix[best, k]):
                best = i
        if best != k:
            for j in range(k, n):
                matrix[k, j], matrix[best, j] = matrix[best, j], matrix[k, j]
            work[RESIDUAL, k], work[RESIDUAL, best] = work[RESIDUAL, best], work[RESIDUAL, k]
        for i in range(k + 1, n):
            factor = matrix[i, k] / matrix[k, k]
            for j in range(k, n):
                matrix[i, j] -= factor * matrix[k, j]
            work[RESIDUAL, i] -= factor * work[RESIDUAL, k]
    for k in range(n - 1, -1, -1):
        for j in range(k + 1, n):
            work[RESIDUAL, k] -= matrix[k, j] * work[RESIDUAL, j]
        work[RESIDUAL, k] /= matrix[k, k]
