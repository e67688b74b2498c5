r"""The element slot: volumetric response of linear tetrahedra.

``P1`` evaluates the volumetric energy :math:`\tfrac K2 (J-1)^2` in every element; nearly incompressible, it locks, and
K then acts as a stiffness of the whole wall. ``Mixed`` adds one pressure unknown per node,

.. math:: \Pi = p (J - 1) - \frac{p^2}{2K} - \frac{\alpha}{2} (p - \bar p)^2 ,

with the pressure-projection stabilisation of Bochev and Dohrmann (:math:`\bar p` is the mean over the element,
:math:`\alpha = 1/G` with the shear modulus :math:`G = 2(c_1 + c_2)`), and does not lock.
Source: Dohrmann and Bochev, Int. J. Numer. Meth. Fluids 46 (2004) 183.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats, Integers

CONSISTENT_MASS = (np.ones((4, 4)) + np.eye(4)) / 20.0
"""Integrals of products of shape functions, over the volume."""

PROJECTION_DEFECT = CONSISTENT_MASS - 1.0 / 16.0
"""Integrals of products of shape functions less their means, over the volume."""


class Element(Protocol):
    """Interface of an element; ``dofs`` is the number of unknowns per node."""

    @property
    def dofs(self) -> int: ...
    def pressure(self, x: Floats, tets: Integers, J: Floats, K: float) -> tuple[Floats, Floats]:
        """Wall pressure (m,) [Pa] and its derivative by J at fixed unknowns [Pa]."""

    def add_forces(
        self, x: Floats, tets: Integers, J: Floats, volumes: Floats, K: float, G: float, out: Floats
    ) -> None:
        """Add the equations of the pressure unknowns to ``out`` (n, dofs)."""

    def fill_stiffness(self, slopes: Floats, volumes: Floats, K: float, G: float, out: Floats) -> None:
        """Fill the blocks of the pressure unknowns in the element matrices ``out``."""


@dataclass(frozen=True)
class P1:
    """Displacement element, of three unknowns per node."""

    dofs: int = 3

    def pressure(self, x: Floats, tets: Integers, J: Floats, K: float) -> tuple[Floats, Floats]:  # noqa: ARG002
        return K * (J - 1.0), np.full_like(J, K)

    def add_forces(
        self, x: Floats, tets: Integers, J: Floats, volumes: Floats, K: float, G: float, out: Floats
    ) -> None:
        """No-op: there is no pressure unknown."""

    def fill_stiffness(self, slopes: Floats, volumes: Floats, K: float, G: float, out: Floats) -> None:
        """No-op: the volumetric stiffness is part of the material tangent."""


@dataclass(frozen=True)
class Mixed:
    """Element of displacement and stabilised nodal pressure, of four unknowns per node."""

    dofs: int = 4

    def pressure(self, x: Floats, tets: Integers, J: Floats, K: float) -> tuple[Floats, Floats]:  # noqa: ARG002
        return _mean_pressure(x, tets), np.zeros_like(J)

    def add_forces(
        self, x: Floats, tets: Integers, J: Floats, volumes: Floats, K: float, G: float, out: Floats
    ) -> None:
        _add_volume_equations(x, tets, J, volumes, self._compliance(K, G), out)

    def fill_stiffness(self, slopes: Floats, volumes: Floats, K: float, G: float, out: Floats) -> None:
        _fill_pressure_blocks(slopes, volumes, self._compliance(K, G), out)

    @staticmethod
    def _compliance(K: float, G: float) -> Floats:
        """Compressibility and stabilisation (4, 4) of the nodal pressures [1/Pa]; G is the shear modulus [Pa]."""
        compliance: Floats = CONSISTENT_MASS / K + PROJECTION_DEFECT / G
        return compliance


@njit(cache=True)
def _mean_pressure(x: Floats, tets: Integers) -> Floats:
    result = np.empty(len(tets))
    for e in range(len(tets)):
        result[e] = 0.25 * (x[tets[e, 0], 3] + x[tets[e, 1], 3] + x[tets[e, 2], 3] + x[tets[e, 3], 3])
    return result


@njit(cache=True)
def _add_volume_equations(
    x: Floats, tets: Integers, J: Floats, volumes: Floats, compliance: Floats, out: Floats
) -> None:
    for e in range(len(tets)):
        change, v = 0.25 * (J[e] - 1.0), volumes[e]
        p, q, r, s = x[tets[e, 0], 3], x[tets[e, 1], 3], x[tets[e, 2], 3], x[tets[e, 3], 3]
        for a in range(4):
            c = compliance[a]
            out[tets[e, a], 3] += v * (change - c[0] * p - c[1] * q - c[2] * r - c[3] * s)


@njit(cache=True)
def _fill_pressure_blocks(slopes: Floats, volumes: Floats, compliance: Floats, out: Floats) -> None:
    for e in range(len(volumes)):
        for a in range(4):
            for b in range(4):
                out[e, 4 * a + 3, 4 * b + 3] = -volumes[e] * compliance[a, b]
                for i in range(3):
                    coupling = 0.25 * volumes[e] * slopes[e, a, i]
                    out[e, 4 * a + i, 4 * b + 3] = coupling
                    out[e, 4 * b + 3, 4 * a + i] = coupling


ELEMENTS: dict[str, Element] = {"p1": P1(), "mixed": Mixed()}
