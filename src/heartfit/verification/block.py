"""The project's own wall on a block: its surface moved or pulled as given, its fibres at constant tension."""

from functools import cache
from typing import Any

import numpy as np
from skfem import Basis, ElementTetP1, FacetBasis, MeshTet

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.topology import boundary_faces
from heartfit.mechanics.body import FiniteElementBody, Step, StepFailed, Tissue
from heartfit.verification.grids import named, oriented
from heartfit.verification.manufactured import FIBRE, Manufactured
from heartfit.verification.parts import ConstantTension, Held

Sides = tuple[str, ...]
PULLED: Sides = ("rv_endo", "epi")
"""Sides, z = L and x = L, that may bear the exact traction; the others are always moved as given."""

ITERATIONS = 30
RELATIVE_TOLERANCE = 1e-9


def cube(n: int, L: float) -> VentricularMesh:
    """A cube of edge ``L`` with ``n`` elements along an edge; floor and lid are called cavities."""
    grid = MeshTet.init_tensor(*[np.linspace(0.0, L, n + 1)] * 3)
    points, tets = np.ascontiguousarray(grid.p.T), grid.t.T.astype(np.int64, order="C")
    tets = oriented(points, tets)
    shell = boundary_faces(tets)
    centres = points[shell].mean(axis=1)
    surfaces = {name: shell[np.isclose(centres[:, axis], at)] for name, (axis, at) in _places(L).items()}
    return named(points, tets, surfaces, np.tile(FIBRE, (len(tets), 1)))


@cache
def solve(problem: Manufactured, n: int, element: str, pulled: Sides = ()) -> tuple[VentricularMesh, Floats]:
    """The cube and its unknowns (n, dofs) in equilibrium with the manufactured force; raises StepFailed.

    The sides ``pulled`` bear the exact traction, all others are moved as given.
    """
    mesh = cube(n, problem.L)
    held = np.zeros((len(mesh.points), 3), dtype=bool)
    held[_moved_nodes(mesh, pulled)] = True
    active = ConstantTension(tension_of_fibres=problem.sigma)
    body = FiniteElementBody(mesh, Tissue(problem.material, active, support=Held(held=held), element=element))
    x = np.zeros((len(mesh.points), body.element.dofs))
    x[:, :3] = problem.displacement(mesh.points.T).T
    load = _body_load(problem, mesh)
    for side in pulled:
        load += _traction_load(problem, mesh, side)
    return mesh, _newton(body.endless_step(body.rest()), x, load, held)


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
    grid, (axis, at) = _grid(mesh), _places(problem.L)[side]
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
    """Linear shape functions at the points of a rule exact to degree 5."""
    return Basis(_grid(mesh), ElementTetP1(), intorder=5)


def _grid(mesh: VentricularMesh) -> MeshTet:
    return MeshTet(np.ascontiguousarray(mesh.points.T), np.ascontiguousarray(mesh.tets.T))


def _places(L: float) -> dict[str, tuple[int, float]]:
    return {"lv_endo": (2, 0.0), "rv_endo": (2, L), "base": (0, 0.0), "epi": (0, L)}


def _moved_nodes(mesh: VentricularMesh, pulled: Sides) -> Integers:
    """Nodes of the whole surface but the inside of the sides ``pulled``."""
    shell = boundary_faces(mesh.tets)
    free = [mesh.surfaces[side] for side in pulled]
    keys = {tuple(sorted(face)) for side in free for face in side.tolist()}
    moved: Integers = np.unique(shell[[tuple(sorted(face)) not in keys for face in shell.tolist()]])
    return moved
