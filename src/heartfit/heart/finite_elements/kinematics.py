"""Kinematics of linear tetrahedra.

Symmetric tensors are six-vectors, see :mod:`heartfit.core.arrays`; tangents map engineering strains (shears doubled) to
second Piola-Kirchhoff stresses. The first axis of arrays runs over the elements.
"""

import numpy as np
from numba import njit

from heartfit.core.arrays import COLUMN as COLUMN
from heartfit.core.arrays import ROW as ROW
from heartfit.core.arrays import Floats, Integers


class StepFailed(ArithmeticError):
    """A step or a load has no admissible state; the message states the reason."""


def shape_gradients(points: Floats, tets: Integers) -> tuple[Floats, Floats]:
    r"""Gradients :math:`\nabla N_a` (m, 4, 3) of the linear shape functions and volumes (m,) of the tetrahedra.

    Raises StepFailed unless all volumes are positive.
    """
    edges = points[tets[:, 1:]] - points[tets[:, :1]]
    volumes = np.linalg.det(edges) / 6.0
    if not (volumes > 0.0).all():
        worst = int(np.argmin(volumes))
        raise StepFailed(f"tetrahedron {worst} has volume {volumes[worst]:g} m^3: expected a positive volume")
    inner = np.linalg.inv(edges).transpose(0, 2, 1)
    return np.concatenate([-inner.sum(axis=1, keepdims=True), inner], axis=1), volumes


@njit(cache=True)
def deformation_gradient(u: Floats, tets: Integers, gradients: Floats, F: Floats) -> None:
    r"""Fill ``F`` (m, 3, 3) with :math:`F = I + \sum_a u_a \otimes \nabla N_a`; ``u`` is (n, >= 3)."""
    for e in range(tets.shape[0]):
        _deformation_gradient(u, tets[e], gradients[e], F[e])


@njit(cache=True, inline="always")
def _deformation_gradient(u: Floats, corners: Integers, gradients: Floats, F: Floats) -> None:
    """Fill ``F`` (3, 3) of one element; the gradients of its shape functions add up to zero."""
    for i in range(3):
        first = u[corners[0], i]
        a, b, c = u[corners[1], i] - first, u[corners[2], i] - first, u[corners[3], i] - first
        for j in range(3):
            F[i, j] = a * gradients[1, j] + b * gradients[2, j] + c * gradients[3, j]
        F[i, i] += 1.0


@njit(cache=True)
def right_cauchy_green(F: Floats, C: Floats, J: Floats) -> None:
    r"""Fill ``C`` (m, 6) with :math:`F^T F` and ``J`` (m,) with :math:`\det F`."""
    for e in range(F.shape[0]):
        J[e] = _cauchy_green(F[e], C[e])


@njit(cache=True)
def _cauchy_green(F: Floats, C: Floats) -> float:
    r"""Fill ``C`` (6,) with :math:`F^T F` of one element; return :math:`\det F`."""
    a, b, c = F[0, 0], F[0, 1], F[0, 2]
    d, e, f = F[1, 0], F[1, 1], F[1, 2]
    g, h, i = F[2, 0], F[2, 1], F[2, 2]
    C[0], C[1], C[2] = a * a + d * d + g * g, b * b + e * e + h * h, c * c + f * f + i * i
    C[3], C[4], C[5] = a * b + d * e + g * h, a * c + d * f + g * i, b * c + e * f + h * i
    determinant: float = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return determinant


@njit(cache=True)
def deform(
    x: Floats, tets: Integers, gradients: Floats, dyads: Floats, F: Floats, C: Floats, J: Floats, e: Floats
) -> float:
    """Fill F, C, J and the fibre strains ``e`` (m,) at the unknowns ``x`` (n, >= 3); return the smallest J."""
    smallest = np.inf
    for i in range(e.size):
        _deformation_gradient(x, tets[i], gradients[i], F[i])
        J[i] = _cauchy_green(F[i], C[i])
        e[i] = _strain_along(C[i], dyads[i])
        smallest = min(smallest, J[i])
    return smallest


@njit(cache=True)
def _strain_along(C: Floats, dyad: Floats) -> float:
    normal = dyad[0] * C[0] + dyad[1] * C[1] + dyad[2] * C[2]
    shear = dyad[3] * C[3] + dyad[4] * C[4] + dyad[5] * C[5]
    strain: float = 0.5 * (normal - 1.0) + shear
    return strain


@njit(cache=True)
def inverse(C: Floats, determinant: float, out: Floats) -> None:
    """Fill ``out`` (6,) with the inverse of the symmetric tensor ``C`` (6,), whose ``determinant`` is known."""
    out[0], out[1], out[2], out[3], out[4], out[5] = inverse_entries(C, determinant)


@njit(cache=True, error_model="numpy", inline="always")
def inverse_entries(C: Floats, determinant: float) -> tuple[float, float, float, float, float, float]:
    """Entries of :func:`inverse`; with no array for them, a loop over elements is compiled to take several at once."""
    a, b, c, d, e, f = C[0], C[1], C[2], C[3], C[4], C[5]
    per = 1.0 / determinant
    plane = per * (b * c - f * f), per * (a * c - e * e), per * (a * b - d * d)
    return (*plane, per * (e * f - d * c), per * (d * f - e * b), per * (d * e - a * f))


@njit(cache=True)
def symmetric_product(A: Floats, i: int, j: int) -> float:
    r"""Entry (i, j) of :math:`A \odot A`, which maps X to A X A: :math:`\frac12 (A_{ik} A_{jl} + A_{il} A_{jk})`."""
    r, c, k, m = ROW[i], COLUMN[i], ROW[j], COLUMN[j]
    return 0.5 * (A[VOIGT[r, k]] * A[VOIGT[c, m]] + A[VOIGT[r, m]] * A[VOIGT[c, k]])


VOIGT = np.array([[0, 3, 4], [3, 1, 5], [4, 5, 2]])
"""Positions of the entries of a symmetric tensor in its six-vector."""


def fibre_dyads(fibres: Floats) -> Floats:
    r"""Six-vectors (m, 6) of :math:`f \otimes f` for unit fibres (m, 3)."""
    return np.ascontiguousarray(fibres[:, ROW] * fibres[:, COLUMN])


def push_forward(dyads: Floats, F: Floats) -> Floats:
    r"""Six-vectors (m, 6) of :math:`F H F^T / \mathrm{tr}`: mean dyads H of unit fibres, mapped by F (m, 3, 3)."""
    deformed = np.einsum("eij,ejk,elk->eil", F, dyads[:, VOIGT], F)
    unit: Floats = (deformed / np.trace(deformed, axis1=1, axis2=2)[:, None, None])[:, ROW, COLUMN]
    return unit


@njit(cache=True)
def fibre_strain(C: Floats, dyads: Floats) -> Floats:
    r"""Green-Lagrange fibre strain :math:`e_{1D} = (f \cdot C f - 1)/2`, (m,); its mean for mean dyads."""
    strain = np.empty(len(C))
    for e in range(len(C)):
        strain[e] = _strain_along(C[e], dyads[e])
    return strain
