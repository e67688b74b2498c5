"""The project's own wall on a block: its surface moved as given, its fibres at constant tension."""

from dataclasses import dataclass
from functools import cache

import numpy as np
from skfem import Basis, ElementTetP1, MeshTet

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh, element_volumes
from heartfit.geometry.topology import boundary_faces
from heartfit.mechanics.active.bcs import BestelClementSorine, Drive
from heartfit.mechanics.body import FiniteElementBody, Step, StepFailed, Tissue
from heartfit.mechanics.support import Support
from heartfit.verification.manufactured import FIBRE, Manufactured

CLAMP = 1e9
"""Springs, N/m, that leave a clamped node where it is in a Newton step."""

ITERATIONS = 30
RELATIVE_TOLERANCE = 1e-9


@dataclass(frozen=True)
class ConstantTension(BestelClementSorine):
    """Fibres of the tension ``tension_of_fibres``, Pa, whatever their strain."""

    tension_of_fibres: float = 0.0

    def respond(self, drive: Drive, e_old: Floats, e_new: Floats, state: Floats, out: Floats) -> None:  # noqa: ARG002
        out[0], out[1:] = self.tension_of_fibres, 0.0


@dataclass(frozen=True)
class Clamped(Support):
    """Nothing but a clamp on the whole surface; what it bears is no equation of the problem."""

    def stiffness(self, mesh: VentricularMesh) -> Floats:
        result = np.zeros((len(mesh.points), 3, 3))
        result[_surface_nodes(mesh)] = CLAMP * np.eye(3)
        return result

    def damping(self, mesh: VentricularMesh) -> Floats:
        return np.zeros((len(mesh.points), 3, 3))

    def passive_scale(self, mesh: VentricularMesh) -> Floats:
        return np.ones(len(mesh.tets))


def cube(n: int, L: float) -> VentricularMesh:
    """A cube of edge ``L`` with ``n`` elements along an edge; floor and lid are called cavities."""
    grid = MeshTet.init_tensor(*[np.linspace(0.0, L, n + 1)] * 3)
    points, tets = np.ascontiguousarray(grid.p.T), grid.t.T.astype(np.int64, order="C")
    mirrored = element_volumes(points, tets) < 0.0
    tets[mirrored] = tets[mirrored][:, [0, 2, 1, 3]]
    shell = boundary_faces(tets)
    centres = points[shell].mean(axis=1)
    surfaces = {name: shell[np.isclose(centres[:, axis], at)] for name, (axis, at) in _places(L).items()}
    fibres, times = np.tile(FIBRE, (len(tets), 1)), np.zeros(len(tets))
    return VentricularMesh(points, tets, surfaces, fibres, None, times, np.zeros(len(points)))


@cache
def solve(problem: Manufactured, n: int, element: str) -> tuple[VentricularMesh, Floats]:
    """The cube and its unknowns (n, dofs) in equilibrium with the manufactured force; raises StepFailed."""
    mesh = cube(n, problem.L)
    active = ConstantTension(tension_of_fibres=problem.sigma)
    body = FiniteElementBody(mesh, Tissue(problem.material, active, support=Clamped(), element=element))
    x = np.zeros((len(mesh.points), body.element.dofs))
    x[:, :3] = problem.displacement(mesh.points.T).T
    return mesh, _newton(body.endless_step(body.rest()), x, _load(problem, mesh))


def _newton(step: Step, x: Floats, load: Floats) -> Floats:
    clamped, first = _surface_nodes(step.body.reference), np.inf
    for _ in range(ITERATIONS):
        residual = step.forces(x).reshape(x.shape)
        residual[:, :3] -= load
        residual[clamped, :3] = 0.0
        size = step.size(residual)
        first = min(first, max(size, float(np.linalg.norm(load))))
        if size < RELATIVE_TOLERANCE * first:
            return x
        change = step.tangent(x).solve(residual.ravel()).reshape(x.shape)
        change[clamped, :3] = 0.0
        x = x - change
    raise StepFailed(f"the block finds no equilibrium, residual {size:.3g} N of {first:.3g} N")


def _load(problem: Manufactured, mesh: VentricularMesh) -> Floats:
    """Nodal forces (n, 3) of the body force."""
    basis = quadrature(mesh)
    force = problem.force(np.asarray(basis.global_coordinates())) * basis.dx
    load = np.zeros_like(mesh.points)
    for a in range(4):
        share = np.einsum("ieq,eq->ei", force, np.broadcast_to(np.asarray(basis.basis[a][0]), basis.dx.shape))
        np.add.at(load, basis.mesh.t[a], share)
    return load


def quadrature(mesh: VentricularMesh) -> Basis:
    """Linear shape functions at the points of a rule exact to degree 5."""
    grid = MeshTet(np.ascontiguousarray(mesh.points.T), np.ascontiguousarray(mesh.tets.T))
    return Basis(grid, ElementTetP1(), intorder=5)


def _places(L: float) -> dict[str, tuple[int, float]]:
    return {"lv_endo": (2, 0.0), "rv_endo": (2, L), "base": (0, 0.0), "epi": (0, L)}


def _surface_nodes(mesh: VentricularMesh) -> Integers:
    return np.unique(boundary_faces(mesh.tets))
