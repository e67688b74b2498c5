"""How far the solved block is from the manufactured deformation, and how fast that shrinks with the mesh."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from heartfit.geometry.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.verification.block import Sides, quadrature, solve
from heartfit.verification.manufactured import Manufactured


@dataclass(frozen=True)
class Errors:
    """Errors of the displacement over the norm of the exact one: values in L2, gradients in L2 (H1 seminorm)."""

    L2: float
    H1: float


@cache
def errors(problem: Manufactured, n: int, element: str, pulled: Sides = ()) -> Errors:
    """Of the cube with ``n`` elements along an edge, integrated to degree 5; raises StepFailed."""
    mesh, x = solve(problem, n, element, pulled)
    return error_of(problem, mesh, x)


@cache
def pressure_error(problem: Manufactured, n: int) -> float:
    """Error in L2 of the nodal wall pressure of ``mixed`` over the norm of the exact one; raises StepFailed."""
    mesh, x = solve(problem, n, "mixed")
    basis = quadrature(mesh)
    exact = problem.pressure(np.asarray(basis.global_coordinates()))
    found = np.asarray(basis.interpolate(np.ascontiguousarray(x[:, 3])))
    return _norm(found - exact, basis.dx) / _norm(exact, basis.dx)


def error_of(problem: Manufactured, mesh: VentricularMesh, x: Floats) -> Errors:
    """Of the unknowns ``x`` (n, >= 3) on ``mesh``."""
    basis = quadrature(mesh)
    fields = [basis.interpolate(np.ascontiguousarray(x[:, i])) for i in range(3)]
    X = np.asarray(basis.global_coordinates())
    exact, gradient = problem.displacement(X), problem.displacement_gradient(X)
    value = np.stack([np.asarray(each) for each in fields]) - exact
    slope = np.stack([np.asarray(each.grad) for each in fields]) - gradient
    norms = [_norm(each, basis.dx) for each in (value, exact, slope, gradient)]
    return Errors(norms[0] / norms[1], norms[2] / norms[3])


def order(coarse: float, fine: float, refinement: float = 2.0) -> float:
    """Observed order of an error that a mesh of ``refinement`` times shorter edges shrinks."""
    return float(np.log(coarse / fine) / np.log(refinement))


def _norm(field: Floats, dx: Floats) -> float:
    squares = (field**2).reshape(-1, *dx.shape).sum(axis=0)
    return float(np.sqrt((squares * dx).sum()))
