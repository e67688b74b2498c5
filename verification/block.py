r"""Manufactured solution of a block: a deformation for which body force and traction are known exactly.

The map is a stretch of the height followed by three shears,

.. math:: z' = Z + d(Z), \quad x = X + f(Y, z'), \quad y = Y + g(x, z'), \quad z = z' + h(x, y),

with sines for f, g, h, in axes rotated against the block. Shears keep volumes, so :math:`J = 1 + d'(Z)`; with
:math:`d' = (p_0 / K) \cos(2 \pi Z / L)` the wall pressure :math:`K (J-1)` stays the same as K grows, so an error that
grows with K is locking. Fibres have a constant tension and nodes are clamped. The force is :math:`b =
-\mathrm{Div} P` of

.. math:: P = \partial W / \partial F + \sigma\, F f \otimes f ,

differentiated by a complex step, which has no truncation error beyond round-off; the traction is P N.
Source of the method: Salari and Knupp, SAND2000-1444; of the step: Squire and Trapp, SIAM Rev. 40 (1998) 110.
"""

from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np
from skfem import Basis, ElementTetP1, FacetBasis, MeshTet

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.cube import FIBRE, cube, sides_of_cube
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.surface import boundary_faces
from heartfit.heart.finite_elements.body import FiniteElementBody, Step, StepFailed, Tissue
from heartfit.heart.muscle.bcs import BestelClementSorine, Drive
from heartfit.heart.muscle.passive import MooneyRivlin
from heartfit.heart.muscle.tissue import Support

CLAMP = 1e9
"""Stiffness of the clamp [N/m]: a clamped node does not move in a Newton step. Its residual is not part of
the problem.
"""


@dataclass(frozen=True)
class ConstantTension(BestelClementSorine):
    """Fibres of the constant tension ``tension_of_fibres`` [Pa] at any strain."""

    tension_of_fibres: float = 0.0

    def respond(self, drive: Drive, e_old: Floats, e_new: Floats, state: Floats, out: Floats) -> None:  # noqa: ARG002
        out[0], out[1:] = self.tension_of_fibres, 0.0


@dataclass(frozen=True)
class Held(Support):
    """Support by a clamp on the components ``held`` (n, 3) of the displacement alone."""

    held: np.ndarray = field(default_factory=lambda: np.zeros((0, 3), dtype=bool))

    def stiffness(self, mesh: VentricularMesh) -> Floats:  # noqa: ARG002
        result: Floats = CLAMP * self.held[:, :, None] * np.eye(3)
        return result

    def damping(self, mesh: VentricularMesh) -> Floats:
        return np.zeros((len(mesh.points), 3, 3))

    def passive_scale(self, mesh: VentricularMesh) -> Floats:
        return np.ones(len(mesh.tets))


COMPLEX_STEP = 1e-30
FRAME = np.array([[2.0, -1.0, 2.0], [2.0, 2.0, -1.0], [-1.0, 2.0, 2.0]]) / 3.0
"""Axes of the deformation by row: shears along the edges of a regular mesh would not lock."""


@dataclass(frozen=True)
class Manufactured:
    """Deformation of a cube of edge ``L`` [m] under the fibre tension ``sigma`` [Pa]; points are (3, ...).

    ``shear`` is the amplitude of the shear angles, ``waves`` their half-waves along an edge, ``p_0`` [Pa] the
    amplitude of the wall pressure.
    """

    material: MooneyRivlin = field(default_factory=MooneyRivlin)
    sigma: float = 2e4
    L: float = 0.02
    shear: float = 0.15
    waves: float = 2.0
    p_0: float = 5e3

    def position(self, X: np.ndarray) -> np.ndarray:
        """x(X), the deformed points."""
        x, y, z = _rotate(FRAME, X)
        z = z + self._lift(z)
        x = x + self._wave(y, z)
        y = y + self._wave(x, z)
        return _rotate(FRAME.T, np.stack([x, y, z + self._wave(x, y)]))

    def displacement(self, X: Floats) -> Floats:
        """u(X) = x - X."""
        return self.position(X) - X

    def deformation_gradient(self, X: np.ndarray) -> np.ndarray:
        """F (3, 3, ...), product of the gradients of stretch and shears."""
        x, y, z = _rotate(FRAME, X)
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
        """Wall pressure K (J - 1) [Pa]."""
        height = _rotate(FRAME, X)[2]
        pressure: Floats = self.p_0 * np.cos(2.0 * np.pi * height / self.L)
        return pressure

    def stress(self, F: np.ndarray) -> np.ndarray:
        """First Piola-Kirchhoff stress P (3, 3, ...) [Pa]."""
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
        """Body force b (3, ...) per reference volume [N/m^3]."""
        divergence = np.zeros_like(X)
        for j in range(3):
            perturbed = X.astype(complex)
            perturbed[j] += 1j * COMPLEX_STEP
            divergence += self.stress(self.deformation_gradient(perturbed))[:, j].imag / COMPLEX_STEP
        return -divergence

    def traction(self, X: Floats, normals: Floats) -> Floats:
        """Force (3, ...) per reference area [Pa] on faces of the outward unit ``normals`` (3, ...)."""
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


def _rotate(frame: Floats, X: np.ndarray) -> np.ndarray:
    return np.einsum("ij,j...->i...", frame, X)


def _times(A: np.ndarray, B: np.ndarray) -> np.ndarray:
    return np.einsum("ij...,jk...->ik...", A, B)


def _determinant(F: np.ndarray) -> np.ndarray:
    return np.einsum("i...,i...->...", F[0], np.cross(F[1], F[2], axis=0))


Sides = tuple[str, ...]
PULLED: Sides = ("rv_endo", "epi")
"""Sides z = L and x = L, which can bear the exact traction; all others have prescribed displacements."""

ITERATIONS = 30
RELATIVE_TOLERANCE = 1e-9


@cache
def solve(problem: Manufactured, n: int, element: str, pulled: Sides = ()) -> tuple[VentricularMesh, Floats]:
    """Solve for the cube and its unknowns (n, dofs) in equilibrium with the manufactured force; raises StepFailed.

    The sides ``pulled`` bear the exact traction, all others have the exact displacements.
    """
    mesh = cube(n, problem.L)
    held = np.zeros((len(mesh.points), 3), dtype=bool)
    held[_prescribed_nodes(mesh, pulled)] = True
    active = ConstantTension(tension_of_fibres=problem.sigma)
    body = FiniteElementBody(mesh, Tissue(problem.material, active, support=Held(held=held), element=element))
    x = np.zeros((len(mesh.points), body.element.dofs))
    x[:, :3] = problem.displacement(mesh.points.T).T
    load = _body_load(problem, mesh)
    for side in pulled:
        load += _traction_load(problem, mesh, side)
    return mesh, _newton(body.static_step(body.rest()), x, load, held)


def _newton(step: Step, x: Floats, load: Floats, held: np.ndarray) -> Floats:
    first = np.inf
    for _ in range(ITERATIONS):
        residual = step.forces(x).reshape(x.shape)
        residual[:, :3] -= load
        residual[:, :3][held] = 0.0
        size = step.size(residual)
        first = min(first, max(size, float(np.linalg.norm(load))))
        if size < RELATIVE_TOLERANCE * first:
            return x
        change = step.tangent(x).solve(residual.ravel()).reshape(x.shape)
        change[:, :3][held] = 0.0
        x = x - change
    raise StepFailed(f"the block finds no equilibrium, residual {size:.3g} N of {first:.3g} N")


def _body_load(problem: Manufactured, mesh: VentricularMesh) -> Floats:
    """Nodal forces (n, 3) of the body force."""
    basis = quadrature(mesh)
    return _spread(problem.force(np.asarray(basis.global_coordinates())), basis, np.asarray(basis.mesh.t))


def _traction_load(problem: Manufactured, mesh: VentricularMesh, side: str) -> Floats:
    """Nodal forces (n, 3) of the exact traction on a side."""
    grid, (axis, at) = _grid(mesh), sides_of_cube(problem.L)[side]
    facets = grid.facets_satisfying(lambda X: np.isclose(X[axis], at), boundaries_only=True)
    basis = FacetBasis(grid, ElementTetP1(), facets=facets, intorder=5)
    X, normals = np.asarray(basis.global_coordinates()), np.asarray(basis.normals)
    return _spread(problem.traction(X, normals), basis, np.asarray(grid.t[:, basis.tind]))


def _spread(density: Floats, basis: Any, corners: Integers) -> Floats:
    """Nodal forces (n, 3) of a density (3, e, q) at the quadrature points; ``corners`` (4, e) are global nodes."""
    load = np.zeros((basis.mesh.p.shape[1], 3))
    for a in range(4):
        shape = np.broadcast_to(np.asarray(basis.basis[a][0]), basis.dx.shape)
        np.add.at(load, corners[a], np.einsum("ieq,eq,eq->ei", density, shape, basis.dx))
    return load


def quadrature(mesh: VentricularMesh) -> Basis:
    """Linear shape functions at the points of a quadrature rule of degree 5."""
    return Basis(_grid(mesh), ElementTetP1(), intorder=5)


def _grid(mesh: VentricularMesh) -> MeshTet:
    return MeshTet(np.ascontiguousarray(mesh.points.T), np.ascontiguousarray(mesh.tets.T))


def _prescribed_nodes(mesh: VentricularMesh, pulled: Sides) -> Integers:
    """Nodes of the surface, except the interior of the sides ``pulled``."""
    shell = boundary_faces(mesh.tets)
    free = [mesh.surfaces[side] for side in pulled]
    keys = {tuple(sorted(face)) for side in free for face in side.tolist()}
    nodes: Integers = np.unique(shell[[tuple(sorted(face)) not in keys for face in shell.tolist()]])
    return nodes
