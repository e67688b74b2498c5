"""Assembly of nodal forces and element stiffness matrices from element stresses and material tangents."""

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats, Integers
from heartfit.heart.finite_elements.kinematics import inverse, inverse_entries, symmetric_product


@njit(cache=True, error_model="numpy")
def add_stresses(
    C: Floats,
    J: Floats,
    p: Floats,
    C_now: Floats,
    C_before: Floats,
    ahead: float,
    viscosity: float,
    tension: Floats,
    dyads: Floats,
    S: Floats,
) -> None:
    r"""Add :math:`p J C^{-1}`, ``viscosity`` times :math:`C - C^*` and ``tension`` along the fibres to ``S``.

    The starting value is :math:`C^* = C_{now} + a (C_{now} - C_{before})` with a = ``ahead``.
    """
    for e in range(C.shape[0]):
        volumetric = p[e] * J[e]
        xx, yy, zz, xy, xz, yz = inverse_entries(C[e], J[e] * J[e])
        for i, entry in ((0, xx), (1, yy), (2, zz), (3, xy), (4, xz), (5, yz)):
            start = C_now[e, i] + ahead * (C_now[e, i] - C_before[e, i])
            S[e, i] += volumetric * entry + viscosity * (C[e, i] - start) + tension[e] * dyads[e, i]


@njit(cache=True, error_model="numpy")
def add_tangents(
    C: Floats,
    J: Floats,
    p: Floats,
    slope: Floats,
    viscosity: float,
    stiffness: Floats,
    dyads: Floats,
    D: Floats,
) -> None:
    r"""Add the derivatives of :func:`add_stresses` to ``D`` (m, 6, 6).

    ``slope`` is :math:`p'(J)`, ``stiffness`` the derivative of the tension by the fibre strain. The volumetric part is
    :math:`(pJ + p'J^2) C^{-1}\otimes C^{-1} - 2 p J\, C^{-1}\odot C^{-1}`.
    """
    Ci = np.empty(6)
    for e in range(C.shape[0]):
        inverse(C[e], J[e] * J[e], Ci)
        a, b = p[e] * J[e] + slope[e] * J[e] * J[e], 2.0 * p[e] * J[e]
        for i in range(6):
            for j in range(6):
                volumetric = a * Ci[i] * Ci[j] - b * symmetric_product(Ci, i, j)
                D[e, i, j] += volumetric + stiffness[e] * dyads[e, i] * dyads[e, j]
            D[e, i, i] += viscosity * (2.0 if i < 3 else 1.0)


@njit(cache=True)
def add_nodal_forces(
    F: Floats, S: Floats, gradients: Floats, volumes: Floats, tets: Integers, out: Floats
) -> None:
    r"""Add :math:`\int F S \nabla N_a` to the first three columns of ``out`` (n, >= 3)."""
    for e in range(tets.shape[0]):
        f, s, g, v = F[e], S[e], gradients[e], volumes[e]
        for i in range(3):
            x = v * (f[i, 0] * s[0] + f[i, 1] * s[3] + f[i, 2] * s[4])
            y = v * (f[i, 0] * s[3] + f[i, 1] * s[1] + f[i, 2] * s[5])
            z = v * (f[i, 0] * s[4] + f[i, 1] * s[5] + f[i, 2] * s[2])
            for a in range(4):
                out[tets[e, a], i] += x * g[a, 0] + y * g[a, 1] + z * g[a, 2]


@njit(cache=True)
def add_support_forces(
    stiffness: Floats, damping: Floats, rate: float, x: Floats, start: Floats, out: Floats
) -> None:
    """Add the forces of springs (n, 3, 3) at the displacements ``x`` and of dampers at ``rate`` (x - start) to ``out``.

    Only the first three columns of ``x``, ``start`` and ``out`` (n, >= 3) count.
    """
    for n in range(len(x)):
        for i in range(3):
            force = 0.0
            for j in range(3):
                force += stiffness[n, i, j] * x[n, j]
                force += rate * damping[n, i, j] * (x[n, j] - start[n, j])
            out[n, i] += force


@njit(cache=True, error_model="numpy")
def element_stiffness(
    F: Floats, S: Floats, D: Floats, gradients: Floats, volumes: Floats, dofs: int, out: Floats
) -> None:
    r"""Fill the displacement blocks of ``out`` (m, 4 dofs, 4 dofs) with material and geometric stiffness."""
    B, DB, K = np.empty((6, 12)), np.empty((6, 12)), np.empty((12, 12))
    for e in range(F.shape[0]):
        _strains(F[e], gradients[e], B)
        _multiply(D[e], B, DB)
        _multiply(B.T, DB, K)
        _add_geometric(S[e], gradients[e], K)
        for a in range(4):
            for i in range(3):
                for b in range(4):
                    for j in range(3):
                        out[e, dofs * a + i, dofs * b + j] = volumes[e] * K[3 * a + i, 3 * b + j]


@njit(cache=True, error_model="numpy")
def _strains(F: Floats, gradients: Floats, B: Floats) -> None:
    """Fill ``B`` (6, 12) with the derivatives of the engineering strains by the displacements."""
    for a in range(4):
        for i in range(3):
            for r in range(3):
                B[r, 3 * a + i] = F[i, r] * gradients[a, r]
            B[3, 3 * a + i] = F[i, 0] * gradients[a, 1] + F[i, 1] * gradients[a, 0]
            B[4, 3 * a + i] = F[i, 0] * gradients[a, 2] + F[i, 2] * gradients[a, 0]
            B[5, 3 * a + i] = F[i, 1] * gradients[a, 2] + F[i, 2] * gradients[a, 1]


@njit(cache=True, error_model="numpy")
def _multiply(A: Floats, B: Floats, out: Floats) -> None:
    """Fill ``out`` with the product A B of small matrices, of which B has 6 rows and 12 columns."""
    for i in range(A.shape[0]):
        for j in range(12):
            out[i, j] = 0.0
        for k in range(6):
            for j in range(12):
                out[i, j] += A[i, k] * B[k, j]


@njit(cache=True, error_model="numpy")
def _add_geometric(S: Floats, gradients: Floats, K: Floats) -> None:
    for a in range(4):
        x, y, z = gradients[a]
        left = S[0] * x + S[3] * y + S[4] * z, S[3] * x + S[1] * y + S[5] * z, S[4] * x + S[5] * y + S[2] * z
        for b in range(4):
            value = left[0] * gradients[b, 0] + left[1] * gradients[b, 1] + left[2] * gradients[b, 2]
            for i in range(3):
                K[3 * a + i, 3 * b + i] += value


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
