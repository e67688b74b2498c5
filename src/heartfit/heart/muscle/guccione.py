r"""Transversely isotropic exponential law of Guccione.

.. math::
    W = \tfrac C2 (e^Q - 1), \qquad
    Q = b_f E_{ff}^2 + b_t (E_{ss}^2 + E_{nn}^2 + 2 E_{sn}^2) + 2 b_{fs} (E_{fs}^2 + E_{fn}^2)

in the axes of the fibre f. It depends on the axes through f alone: with :math:`M = f \otimes f`,

.. math:: \tfrac12 \frac{\partial Q}{\partial E} =: H = (b_f - 2 b_{fs} + b_t) (M : E) M
          + (b_{fs} - b_t) (E M + M E) + b_t E, \qquad \bar S = C e^Q H .

E is that of the isochoric part :math:`\bar C = J^{-2/3} C` of the deformation, so that
:math:`S = J^{-2/3} (\bar S - \tfrac13 (\bar S : C) C^{-1})`. In an incompressible wall this alters only the pressure;
in a linear tetrahedron, whose volume is not preserved exactly, the energy of the full C is bounded under compression
and would let it collapse. Sources: Guccione, McCulloch, Waldman, J. Biomech. Eng. 113 (1991) 42; Guccione, Costa,
McCulloch, J. Biomech. 28 (1995) 1167.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats
from heartfit.core.parameter import parameter, require_admissible
from heartfit.heart.finite_elements.kinematics import COLUMN, ROW, VOIGT, inverse, symmetric_product


@dataclass(frozen=True)
class Guccione:
    """Exponential solid, stiffer along its fibres; the default values are those of Land et al. (2015)."""

    C: float = parameter(2e3, unit="Pa", symbol="C", meaning="scale of the exponential law")
    b_f: float = parameter(8.0, unit="1", symbol="b_f", meaning="exponent along the fibre")
    b_t: float = parameter(2.0, unit="1", symbol="b_t", meaning="exponent across the fibre")
    b_fs: float = parameter(4.0, unit="1", symbol="b_{fs}", meaning="exponent of shears along the fibre")
    G: float = parameter(
        3e4, unit="Pa", symbol="G", meaning="shear modulus under load, stabilises the pressure"
    )
    K: float = parameter(1e6, unit="Pa", symbol="K", meaning="bulk modulus")
    eta: float = parameter(100.0, unit="Pa.s", symbol=r"\eta", meaning="viscosity of the passive matrix")

    def __post_init__(self) -> None:
        require_admissible(self)

    @property
    def shear_modulus(self) -> float:
        """Shear modulus of the loaded tissue [Pa]; at rest it is C b_t / 2 across and C b_fs / 2 along the fibre."""
        return self.G

    def stress(self, C: Floats, J: Floats, scale: Floats, dyads: Floats, S: Floats) -> None:
        """Fill ``S`` (m, 6) with the isochoric stress [Pa]; ``scale`` (m,) multiplies C."""
        _stress(C, J, self.C * scale, dyads, self._exponents(), S)

    def tangent(self, C: Floats, J: Floats, scale: Floats, dyads: Floats, D: Floats) -> None:
        r"""Fill ``D`` (m, 6, 6) with :math:`2\,\partial S/\partial C` of the isochoric stress."""
        _tangent(C, J, self.C * scale, dyads, self._exponents(), D)

    def _exponents(self) -> Floats:
        """Factors (3,) of (M : E) M, E M + M E and E in H."""
        return np.array([self.b_f - 2.0 * self.b_fs + self.b_t, self.b_fs - self.b_t, self.b_t])


@njit(cache=True)
def _contraction(A: Floats, B: Floats) -> float:
    """A : B of symmetric tensors."""
    return A[0] * B[0] + A[1] * B[1] + A[2] * B[2] + 2.0 * (A[3] * B[3] + A[4] * B[4] + A[5] * B[5])


@njit(cache=True)
def _slope(C: Floats, j: float, M: Floats, b: Floats, H: Floats) -> float:
    """Fill H and return Q = H : E at the Green-Lagrange strain of ``j C``."""
    E = 0.5 * j * C
    E[:3] -= 0.5
    along = _contraction(E, M)
    for i in range(6):
        r, c = ROW[i], COLUMN[i]
        mixed = 0.0
        for k in range(3):
            mixed += E[VOIGT[r, k]] * M[VOIGT[k, c]] + M[VOIGT[r, k]] * E[VOIGT[k, c]]
        H[i] = b[0] * along * M[i] + b[1] * mixed + b[2] * E[i]
    return _contraction(H, E)


@njit(cache=True)
def _curvature(M: Floats, b: Floats, i: int, j: int) -> float:
    """Entry (i, j) of the derivative of H by E."""
    r, c, k, m = ROW[i], COLUMN[i], ROW[j], COLUMN[j]
    unit = 0.5 * ((r == k) * (c == m) + (r == m) * (c == k))
    mixed = (r == k) * M[VOIGT[c, m]] + (r == m) * M[VOIGT[c, k]]
    mixed += (c == m) * M[VOIGT[r, k]] + (c == k) * M[VOIGT[r, m]]
    return b[0] * M[i] * M[j] + 0.5 * b[1] * mixed + b[2] * unit


@njit(cache=True)
def _stress(C: Floats, J: Floats, moduli: Floats, dyads: Floats, b: Floats, S: Floats) -> None:
    Ci, H = np.empty(6), np.empty(6)
    for e in range(C.shape[0]):
        inverse(C[e], J[e] * J[e], Ci)
        j = J[e] ** (-2.0 / 3.0)
        factor = moduli[e] * np.exp(_slope(C[e], j, dyads[e], b, H))
        trace = _contraction(H, C[e])
        for i in range(6):
            S[e, i] = j * factor * (H[i] - trace / 3.0 * Ci[i])


@njit(cache=True)
def _tangent(C: Floats, J: Floats, moduli: Floats, dyads: Floats, b: Floats, D: Floats) -> None:
    Ci, H, along, B = np.empty(6), np.empty(6), np.empty(6), np.empty((6, 6))
    for e in range(C.shape[0]):
        inverse(C[e], J[e] * J[e], Ci)
        j = J[e] ** (-2.0 / 3.0)
        factor = moduli[e] * np.exp(_slope(C[e], j, dyads[e], b, H))
        trace = _contraction(H, C[e])
        for i in range(6):
            for k in range(6):
                B[i, k] = 2.0 * H[i] * H[k] + _curvature(dyads[e], b, i, k)
            along[i] = _contraction(B[i], C[e])
        twice = _contraction(along, C[e])
        for i in range(6):
            for k in range(6):
                cc = Ci[i] * Ci[k]
                projected = B[i, k] - (Ci[i] * along[k] + along[i] * Ci[k]) / 3.0 + twice / 9.0 * cc
                sided = Ci[i] * H[k] + H[i] * Ci[k] - trace / 3.0 * cc - trace * symmetric_product(Ci, i, k)
                D[e, i, k] = factor * j * (j * projected - 2.0 / 3.0 * sided)
