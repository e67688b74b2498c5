"""From element stresses to nodal forces and to the sparse tangent."""

import numpy as np
from numba import njit

from heartfit.geometry.arrays import Floats, Integers
from heartfit.mechanics.kinematics import COLUMN, ROW, inverse, symmetric_product


@njit(cache=True, error_model="numpy")
def add_stresses(
    C: Floats,
    J: Floats,
    p: Floats,
    C_start: Floats,
    viscosity: float,
    tension: Floats,
    dyads: Floats,
    S: Floats,
) -> None:
    r"""Add :math:`p J C^{-1}`, ``viscosity`` times :math:`C - C_{start}` and ``tension`` along the fibres to ``S``."""
    Ci = np.empty(6)
    for e in range(C.shape[0]):
        inverse(C[e], J[e] * J[e], Ci)
        for i in range(6):
            viscous = viscosity * (C[e, i] - C_start[e, i])
            S[e, i] += p[e] * J[e] * Ci[i] + viscous + tension[e] * dyads[e, i]


@njit(cache=True)
def add_volumetric_tangent(C: Floats, J: Floats, p: Floats, slope: Floats, D: Floats) -> None:
    r"""Add :math:`(pJ + p'J^2) C^{-1}\otimes C^{-1} - 2 p J\, C^{-1}\odot C^{-1}`, ``slope`` being p'(J)."""
    Ci = np.empty(6)
    for e in range(C.shape[0]):
        inverse(C[e], J[e] * J[e], Ci)
        a, b = p[e] * J[e] + slope[e] * J[e] * J[e], 2.0 * p[e] * J[e]
        for i in range(6):
            for j in range(6):
                D[e, i, j] += a * Ci[i] * Ci[j] - b * symmetric_product(Ci, i, j)


@njit(cache=True)
def add_nodal_forces(
    F: Floats, S: Floats, gradients: Floats, volumes: Floats, tets: Integers, out: Floats
) -> None:
    r"""Add :math:`\int F S \nabla N_a` to the first three columns of ``out`` (n, >= 3)."""
    P = np.empty((3, 3))
    for e in range(tets.shape[0]):
        for i in range(3):
            P[i, 0] = F[e, i, 0] * S[e, 0] + F[e, i, 1] * S[e, 3] + F[e, i, 2] * S[e, 4]
            P[i, 1] = F[e, i, 0] * S[e, 3] + F[e, i, 1] * S[e, 1] + F[e, i, 2] * S[e, 5]
            P[i, 2] = F[e, i, 0] * S[e, 4] + F[e, i, 1] * S[e, 5] + F[e, i, 2] * S[e, 2]
        for a in range(4):
            for i in range(3):
                force = 0.0
                for j in range(3):
                    force += P[i, j] * gradients[e, a, j]
                out[tets[e, a], i] += volumes[e] * force


@njit(cache=True)
def element_stiffness(  # noqa: C901
    F: Floats, S: Floats, D: Floats, gradients: Floats, volumes: Floats, dofs: int, out: Floats
) -> None:
    r"""Fill the displacement blocks of ``out`` (m, 4 dofs, 4 dofs) with material and geometric stiffness."""
    B, DB = np.empty((6, 12)), np.empty((6, 12))
    for e in range(F.shape[0]):
        g = gradients[e]
        for a in range(4):
            for i in range(3):
                for r in range(6):
                    shear = 1.0 if r < 3 else 2.0
                    value = F[e, i, ROW[r]] * g[a, COLUMN[r]] + F[e, i, COLUMN[r]] * g[a, ROW[r]]
                    B[r, 3 * a + i] = 0.5 * shear * value
        for r in range(6):
            for c in range(12):
                value = 0.0
                for k in range(6):
                    value += D[e, r, k] * B[k, c]
                DB[r, c] = value
        for a in range(4):
            for b in range(4):
                geometric = 0.0
                for r in range(6):
                    value = g[a, ROW[r]] * g[b, COLUMN[r]]
                    if r >= 3:
                        value += g[a, COLUMN[r]] * g[b, ROW[r]]
                    geometric += S[e, r] * value
                for i in range(3):
                    for j in range(3):
                        value = geometric if i == j else 0.0
                        for r in range(6):
                            value += B[r, 3 * a + i] * DB[r, 3 * b + j]
                        out[e, dofs * a + i, dofs * b + j] = volumes[e] * value


@njit(cache=True)
def volume_slopes(F: Floats, gradients: Floats, out: Floats) -> None:
    r"""Fill ``out`` (m, 4, 3) with :math:`\partial J/\partial u_a = \mathrm{cof}(F) \nabla N_a`."""
    for e in range(F.shape[0]):
        f = F[e]
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            for a in range(4):
                value = 0.0
                for c in range(3):
                    d, b = (c + 1) % 3, (c + 2) % 3
                    value += (f[j, d] * f[k, b] - f[j, b] * f[k, d]) * gradients[e, a, c]
                out[e, a, i] = value
