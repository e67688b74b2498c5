r"""A deformation of a block for which body force and traction are known exactly.

The map is a stretch of the height followed by three shears,

.. math:: z' = Z + d(Z), \quad x = X + f(Y, z'), \quad y = Y + g(x, z'), \quad z = z' + h(x, y),

with sines for f, g, h, in axes turned against the block. Shears keep volumes, so :math:`J = 1 + d'(Z)`; with
:math:`d' = (p_0 / K) \cos(2 \pi Z / L)` the wall pressure :math:`K (J-1)` stays the same as K grows: whatever error
then grows with K is locking. The force is :math:`b = -\mathrm{Div} P` of

.. math:: P = \partial W / \partial F + \sigma\, F f \otimes f ,

differentiated by a complex step, which has no truncation error beyond round-off; the traction is P N.
Source of the method: Salari and Knupp, SAND2000-1444; of the step: Squire and Trapp, SIAM Rev. 40 (1998) 110.
"""

from dataclasses import dataclass, field

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.mechanics.passive.mooney_rivlin import MooneyRivlin

COMPLEX_STEP = 1e-30
FIBRE = np.array([2.0, 1.0, 2.0]) / 3.0
FRAME = np.array([[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]]) / 3.0
"""Rows are the axes of the deformation: along the edges of a regular mesh shears would be free of locking."""


@dataclass(frozen=True)
class Manufactured:
    """The deformation of a cube of edge ``L`` (m) under the fibre tension ``sigma`` (Pa); points are (3, ...).

    ``shear`` is the amplitude of the shear angles, ``waves`` their half-waves along an edge, ``p_0`` (Pa) the
    amplitude of the wall pressure.
    """

    material: MooneyRivlin = field(default_factory=MooneyRivlin)
    sigma: float = 2e4
    L: float = 0.02
    shear: float = 0.15
    waves: float = 2.0
    p_0: float = 5e3

    def position(self, X: np.ndarray) -> np.ndarray:
        """Where the points go."""
        x, y, z = _turned(FRAME, X)
        z = z + self._lift(z)
        x = x + self._wave(y, z)
        y = y + self._wave(x, z)
        return _turned(FRAME.T, np.stack([x, y, z + self._wave(x, y)]))

    def displacement(self, X: Floats) -> Floats:
        """u(X) = x - X."""
        return self.position(X) - X

    def deformation_gradient(self, X: np.ndarray) -> np.ndarray:
        """F (3, 3, ...), the product of the gradients of the stretch and of the shears."""
        x, y, z = _turned(FRAME, X)
        stretch, first, second, third = (_identity(X) for _ in range(4))
        stretch[2, 2] += self.p_0 / self.material.K * np.cos(2.0 * np.pi * z / self.L)
        z = z + self._lift(z)
        first[0, 1], first[0, 2] = self._slopes(y, z)
        x = x + self._wave(y, z)
        second[1, 0], second[1, 2] = self._slopes(x, z)
        y = y + self._wave(x, z)
        third[2, 0], third[2, 1] = self._slopes(x, y)
        inner = _times(third, _times(second, _times(first, stretch)))
        return np.einsum("ai,ab...,bj->ij...", FRAME, inner, FRAME)

    def displacement_gradient(self, X: Floats) -> Floats:
        """F - I."""
        return self.deformation_gradient(X) - _identity(X)

    def pressure(self, X: Floats) -> Floats:
        """Wall pressure K (J - 1), Pa."""
        height = _turned(FRAME, X)[2]
        pressure: Floats = self.p_0 * np.cos(2.0 * np.pi * height / self.L)
        return pressure

    def stress(self, F: np.ndarray) -> np.ndarray:
        """First Piola-Kirchhoff stress P (3, 3, ...), Pa."""
        J, C = _determinant(F), _times(np.swapaxes(F, 0, 1), F)
        trace = np.einsum("ii...->...", C)
        second = 0.5 * (trace**2 - np.einsum("ij...,ji...->...", C, C))
        slope = np.swapaxes(np.linalg.inv(np.moveaxis(F, (0, 1), (-2, -1))), -1, -2)
        J_F = J * np.moveaxis(slope, (-2, -1), (0, 1))
        one = 2.0 * self.material.c_1 * J ** (-2 / 3) * (F - trace / 3.0 * J_F / J)
        two = trace * F - _times(F, C) - 2.0 / 3.0 * second * J_F / J
        passive = one + 2.0 * self.material.c_2 * J ** (-4 / 3) * two + self.material.K * (J - 1.0) * J_F
        return passive + self.sigma * np.einsum("ij...,j,k->ik...", F, FIBRE, FIBRE)

    def force(self, X: Floats) -> Floats:
        """Body force b (3, ...) per reference volume, N/m^3."""
        divergence = np.zeros_like(X)
        for j in range(3):
            moved = X.astype(complex)
            moved[j] += 1j * COMPLEX_STEP
            divergence += self.stress(self.deformation_gradient(moved))[:, j].imag / COMPLEX_STEP
        return -divergence

    def traction(self, X: Floats, normals: Floats) -> Floats:
        """Force (3, ...) per reference area, Pa, on faces of the outward unit ``normals`` (3, ...)."""
        force: Floats = np.einsum("ij...,j...->i...", self.stress(self.deformation_gradient(X)), normals)
        return force

    def _lift(self, z: np.ndarray) -> np.ndarray:
        k = 2.0 * np.pi / self.L
        return self.p_0 / self.material.K / k * np.sin(k * z)

    def _wave(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        k = self.waves * np.pi / self.L
        return self.shear / k * np.sin(k * a) * np.cos(k * b)

    def _slopes(self, a: np.ndarray, b: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        k = self.waves * np.pi / self.L
        return self.shear * np.cos(k * a) * np.cos(k * b), -self.shear * np.sin(k * a) * np.sin(k * b)


def _identity(X: np.ndarray) -> np.ndarray:
    return np.multiply.outer(np.eye(3), np.ones_like(X[0]))


def _turned(frame: Floats, X: np.ndarray) -> np.ndarray:
    return np.einsum("ij,j...->i...", frame, X)


def _times(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    return np.einsum("ij...,jk...->ik...", A, B)


def _determinant(F: np.ndarray) -> np.ndarray:
    return np.einsum("i...,i...->...", F[0], np.cross(F[1], F[2], axis=0))
