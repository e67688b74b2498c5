r"""The passive slot and its standard law, isotropic Mooney-Rivlin tissue.

A passive law is the isochoric part of the stress; the volumetric part, of bulk modulus K, belongs to the element, which
may treat it by a pressure field. Directions are the dyads :math:`f \otimes f` of unit fibres, which an isotropic law
ignores. The standard law is that of Mooney and Rivlin,

.. math:: W = c_1 (\bar I_1 - 3) + c_2 (\bar I_2 - 3) + \tfrac K2 (J-1)^2

with :math:`\bar I_1 = J^{-2/3} I_1`, :math:`\bar I_2 = J^{-4/3} I_2`. Its small-strain shear modulus is
:math:`2 (c_1 + c_2)`.
Source: Marchesseau et al., MICCAI 2012, section 2.
"""

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.core.parameter import parameter, require_admissible
from heartfit.heart.finite_elements.kinematics import inverse, inverse_entries, symmetric_product


class Passive(Protocol):
    """Interface of a passive law, of bulk modulus ``K`` [Pa] and viscosity ``eta`` [Pa.s].

    Arrays run over m elements: ``C`` (m, 6), ``J`` (m,), ``dyads`` (m, 6); ``scale`` (m,) multiplies the moduli.
    """

    def __hash__(self) -> int:
        """Hash by value: equal laws share their tables."""

    @property
    def K(self) -> float: ...
    @property
    def eta(self) -> float: ...
    @property
    def shear_modulus(self) -> float:
        """Shear modulus at small strains [Pa]; weights equations and stabilises the wall pressure."""

    def stress(self, C: Floats, J: Floats, scale: Floats, dyads: Floats, S: Floats) -> None:
        """Fill ``S`` (m, 6) with the second Piola-Kirchhoff stress [Pa]."""

    def tangent(self, C: Floats, J: Floats, scale: Floats, dyads: Floats, D: Floats) -> None:
        r"""Fill ``D`` (m, 6, 6) with :math:`2\,\partial S/\partial C` [Pa]."""


@runtime_checkable
class Isotropic(Protocol):
    """Interface of a law for the wall of a sphere, equal in all directions of its surface.

    ``scale`` multiplies the moduli, as in :class:`Passive`.
    """

    @property
    def eta(self) -> float: ...

    def in_plane_stress(self, stretch: Floats, scale: Floats | float = 1.0) -> Floats:
        r""":math:`dW/d\Lambda` of the incompressible stretch :math:`(\Lambda, \Lambda, \Lambda^{-2})` [Pa]."""

    def in_plane_stiffness(self, stretch: Floats, scale: Floats | float = 1.0) -> Floats:
        """Derivative of :meth:`in_plane_stress` [Pa]."""


def require_isotropic(law: Passive) -> Isotropic:
    """Return the law; raise InputError unless it is isotropic."""
    if not isinstance(law, Isotropic):
        raise InputError(
            f"sphere: the fibres run in all directions: expected an isotropic law, not {type(law).__name__}"
        )
    return law


@dataclass(frozen=True)
class MooneyRivlin:
    """Mooney-Rivlin solid with Kelvin-Voigt viscosity :math:`S_v = \\eta \\dot E`."""

    c_1: float = parameter(6e3, unit="Pa", symbol="c_1", meaning="first Mooney-Rivlin modulus", sd=0.25)
    c_2: float = parameter(6e2, unit="Pa", symbol="c_2", meaning="second Mooney-Rivlin modulus", sd=0.30)
    K: float = parameter(1e6, unit="Pa", symbol="K", meaning="bulk modulus", sd=0.25)
    eta: float = parameter(100.0, unit="Pa.s", symbol=r"\eta", meaning="viscosity of the passive matrix")

    def __post_init__(self) -> None:
        require_admissible(self)

    @property
    def shear_modulus(self) -> float:
        """Small-strain shear modulus [Pa]."""
        return 2.0 * (self.c_1 + self.c_2)

    def stress(self, C: Floats, J: Floats, scale: Floats, dyads: Floats, S: Floats) -> None:  # noqa: ARG002
        """Fill ``S`` (m, 6) with the isochoric stress, ``scale`` (m,) multiplying both moduli."""
        _stress(C, J, np.cbrt(J), scale, self.c_1, self.c_2, S)

    def tangent(self, C: Floats, J: Floats, scale: Floats, dyads: Floats, D: Floats) -> None:  # noqa: ARG002
        r"""Fill ``D`` (m, 6, 6) with :math:`2\,\partial S/\partial C` of the isochoric stress."""
        _tangent(C, J, scale, self.c_1, self.c_2, D)

    def in_plane_stress(self, stretch: Floats, scale: Floats | float = 1.0) -> Floats:
        r""":math:`dW/d\Lambda` of the incompressible stretch :math:`(\Lambda, \Lambda, \Lambda^{-2})` [Pa]."""
        first = 4.0 * self.c_1 * (stretch - stretch**-5)
        result: Floats = scale * (first + 4.0 * self.c_2 * (stretch**3 - stretch**-3))
        return result

    def in_plane_stiffness(self, stretch: Floats, scale: Floats | float = 1.0) -> Floats:
        """Derivative of :meth:`in_plane_stress` [Pa]."""
        first = 4.0 * self.c_1 * (1.0 + 5.0 * stretch**-6)
        result: Floats = scale * (first + 4.0 * self.c_2 * (3.0 * stretch**2 + 3.0 * stretch**-4))
        return result


@njit(cache=True, inline="always")
def _invariants(C: Floats) -> tuple[float, float]:
    trace = C[0] + C[1] + C[2]
    squares = C[0] ** 2 + C[1] ** 2 + C[2] ** 2 + 2.0 * (C[3] ** 2 + C[4] ** 2 + C[5] ** 2)
    return trace, 0.5 * (trace * trace - squares)


@njit(cache=True, error_model="numpy")
def _stress(C: Floats, J: Floats, root: Floats, scale: Floats, c_1: float, c_2: float, S: Floats) -> None:
    """Fill ``S`` (m, 6), with ``root`` (m,) the cube roots of ``J``."""
    for e in range(C.shape[0]):
        I1, I2 = _invariants(C[e])
        power = 1.0 / (root[e] * root[e])
        a, b = 2.0 * c_1 * scale[e] * power, 2.0 * c_2 * scale[e] * power * power
        xx, yy, zz, xy, xz, yz = inverse_entries(C[e], J[e] * J[e])
        for i, entry in ((0, xx), (1, yy), (2, zz), (3, xy), (4, xz), (5, yz)):
            identity = 1.0 if i < 3 else 0.0
            S[e, i] = a * (identity - I1 / 3.0 * entry)
            S[e, i] += b * (I1 * identity - C[e, i] - 2.0 / 3.0 * I2 * entry)


@njit(cache=True)
def _tangent(C: Floats, J: Floats, scale: Floats, c_1: float, c_2: float, D: Floats) -> None:
    Ci, A = np.empty(6), np.empty(6)
    for e in range(C.shape[0]):
        I1, I2 = _invariants(C[e])
        inverse(C[e], J[e] * J[e], Ci)
        a = 4.0 * c_1 * scale[e] * J[e] ** (-2.0 / 3.0)
        b = 4.0 * c_2 * scale[e] * J[e] ** (-4.0 / 3.0)
        for i in range(6):
            A[i] = (I1 if i < 3 else 0.0) - C[e, i]
        for i in range(6):
            di = 1.0 if i < 3 else 0.0
            for j in range(6):
                dj = 1.0 if j < 3 else 0.0
                cc = Ci[i] * Ci[j]
                odot = symmetric_product(Ci, i, j)
                unit = 0.0 if i != j else (1.0 if i < 3 else 0.5)
                D[e, i, j] = a * (-(di * Ci[j] + Ci[i] * dj) / 3.0 + I1 / 9.0 * cc + I1 / 3.0 * odot)
                D[e, i, j] += b * (di * dj - unit - 2.0 / 3.0 * (A[i] * Ci[j] + Ci[i] * A[j]))
                D[e, i, j] += b * (4.0 / 9.0 * I2 * cc + 2.0 / 3.0 * I2 * odot)
