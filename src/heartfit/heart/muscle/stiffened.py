r"""Passive law with additional energies, functions of one invariant each.

With :math:`A = I` for the wall or :math:`A = f \otimes f` for the fibre, and :math:`\bar I = J^{-2/3} A : C`,

.. math:: \bar I_C := \frac{\partial \bar I}{\partial C} = J^{-2/3} \Big(A - \frac{A : C}{3} C^{-1}\Big), \qquad
          S = 2 W' \bar I_C, \qquad
          2 \frac{\partial S}{\partial C} = 4 W'' \bar I_C \otimes \bar I_C
          + 4 W' \frac{\partial \bar I_C}{\partial C} .

A wall that is stretched by :math:`\Lambda` in its plane, incompressible, has
:math:`\bar I_1 = 2 \Lambda^2 + \Lambda^{-4}` and, with fibres in all directions of the plane,
:math:`\bar I_{4f} = \Lambda^2`. Source: Holzapfel and Ogden, Phil. Trans. R. Soc. A 367 (2009) 3445.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats
from heartfit.heart.finite_elements.kinematics import inverse, symmetric_product
from heartfit.heart.muscle.passive import Passive, require_isotropic
from heartfit.roles import Stress

IDENTITY = np.array([1.0, 1.0, 1.0, 0.0, 0.0, 0.0])
REST_INVARIANTS = {"wall": 3.0, "fibre": 1.0}


@dataclass(frozen=True)
class Stiffened:
    """The ``base`` law plus the energies of mechanisms; annuli and right wall stiffen the base law only."""

    base: Passive
    added: tuple[Stress, ...]

    @property
    def K(self) -> float:
        return self.base.K

    @property
    def eta(self) -> float:
        return self.base.eta

    @property
    def shear_modulus(self) -> float:
        """Shear modulus [Pa] of the base law: the added energies are of higher order in the strain."""
        return self.base.shear_modulus

    def stress(self, C: Floats, J: Floats, scale: Floats, dyads: Floats, S: Floats) -> None:
        """Fill ``S`` (m, 6) with the isochoric stress."""
        self.base.stress(C, J, scale, dyads, S)
        for energy in self.added:
            direction = _structure_tensors(energy, dyads)
            first, _ = energy.slopes(_invariant(C, J, direction) - REST_INVARIANTS[energy.acts_on])
            _add_stress(C, J, direction, first, S)

    def tangent(self, C: Floats, J: Floats, scale: Floats, dyads: Floats, D: Floats) -> None:
        r"""Fill ``D`` (m, 6, 6) with :math:`2\,\partial S/\partial C` of the isochoric stress."""
        self.base.tangent(C, J, scale, dyads, D)
        for energy in self.added:
            direction = _structure_tensors(energy, dyads)
            first, second = energy.slopes(_invariant(C, J, direction) - REST_INVARIANTS[energy.acts_on])
            _add_tangent(C, J, direction, first, second, D)

    def in_plane_stress(self, stretch: Floats, scale: Floats | float = 1.0) -> Floats:
        r""":math:`dW/d\Lambda` of the incompressible stretch :math:`(\Lambda, \Lambda, \Lambda^{-2})` [Pa]."""
        stress = require_isotropic(self.base).in_plane_stress(stretch, scale)
        for energy in self.added:
            x, slope, _ = _in_plane(energy, stretch)
            stress = stress + energy.slopes(x)[0] * slope
        return stress

    def in_plane_stiffness(self, stretch: Floats, scale: Floats | float = 1.0) -> Floats:
        """Derivative of :meth:`in_plane_stress` [Pa]."""
        stiffness = require_isotropic(self.base).in_plane_stiffness(stretch, scale)
        for energy in self.added:
            x, slope, curve = _in_plane(energy, stretch)
            first, second = energy.slopes(x)
            stiffness = stiffness + second * slope**2 + first * curve
        return stiffness


def _structure_tensors(energy: Stress, dyads: Floats) -> Floats:
    """Structure tensors A (m, 6) of the invariant."""
    return dyads if energy.acts_on == "fibre" else np.broadcast_to(IDENTITY, dyads.shape)


def _in_plane(energy: Stress, stretch: Floats) -> tuple[Floats, Floats, Floats]:
    """Argument x of the energy and its first two derivatives by the stretch."""
    if energy.acts_on == "fibre":
        return stretch**2 - 1.0, 2.0 * stretch, np.full_like(stretch, 2.0)
    through = stretch**-4
    x: Floats = 2.0 * stretch**2 + through - 3.0
    return x, 4.0 * (stretch - through / stretch), 4.0 + 20.0 * through / stretch**2


def _invariant(C: Floats, J: Floats, direction: Floats) -> Floats:
    result: Floats = _contraction(C, direction) / np.cbrt(J) ** 2
    return result


def _contraction(C: Floats, A: Floats) -> Floats:
    return (C[:, :3] * A[:, :3]).sum(axis=1) + 2.0 * (C[:, 3:] * A[:, 3:]).sum(axis=1)


@njit(cache=True)
def _invariant_derivative(C: Floats, j: float, A: Floats, Ci: Floats, out: Floats) -> float:
    """Fill ``out`` (6,) with the derivative of the invariant by C; ``j`` is 1/J. Return A : C / 3."""
    third = 0.0
    for i in range(6):
        third += (1.0 if i < 3 else 2.0) * A[i] * C[i] / 3.0
    for i in range(6):
        out[i] = j ** (2.0 / 3.0) * (A[i] - third * Ci[i])
    return third


@njit(cache=True)
def _add_stress(C: Floats, J: Floats, A: Floats, first: Floats, S: Floats) -> None:
    Ci, slope = np.empty(6), np.empty(6)
    for e in range(C.shape[0]):
        inverse(C[e], J[e] * J[e], Ci)
        _invariant_derivative(C[e], 1.0 / J[e], A[e], Ci, slope)
        for i in range(6):
            S[e, i] += 2.0 * first[e] * slope[i]


@njit(cache=True)
def _add_tangent(C: Floats, J: Floats, A: Floats, first: Floats, second: Floats, D: Floats) -> None:
    Ci, slope = np.empty(6), np.empty(6)
    for e in range(C.shape[0]):
        inverse(C[e], J[e] * J[e], Ci)
        third = _invariant_derivative(C[e], 1.0 / J[e], A[e], Ci, slope)
        a, b = 4.0 * first[e] * J[e] ** (-2.0 / 3.0), 4.0 * second[e]
        for i in range(6):
            for j in range(6):
                bent = third * (Ci[i] * Ci[j] / 3.0 + symmetric_product(Ci, i, j))
                bent -= (A[e, i] * Ci[j] + Ci[i] * A[e, j]) / 3.0
                D[e, i, j] += b * slope[i] * slope[j] + a * bent
