"""Errors of the solved block against the manufactured deformation, and their order in the mesh size."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from heartfit.core.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.muscle.passive import MooneyRivlin
from verification.block import PULLED, Manufactured, Sides, quadrature, solve
from verification.check import Check


@dataclass(frozen=True)
class Errors:
    """Errors of the displacement over the norm of the exact one: values in L2, gradients in L2 (H1 seminorm)."""

    L2: float
    H1: float


@cache
def errors(problem: Manufactured, n: int, element: str, pulled: Sides = ()) -> Errors:
    """Errors of the cube with ``n`` elements along an edge, integrated to degree 5; raises StepFailed."""
    mesh, x = solve(problem, n, element, pulled)
    return error_of(problem, mesh, x)


@cache
def pressure_error(problem: Manufactured, n: int) -> float:
    """Relative L2 error of the nodal wall pressure of ``mixed``; raises StepFailed."""
    mesh, x = solve(problem, n, "mixed")
    basis = quadrature(mesh)
    exact = problem.pressure(np.asarray(basis.global_coordinates()))
    nodal = np.asarray(basis.interpolate(np.ascontiguousarray(x[:, 3])))
    return _norm(nodal - exact, basis.dx) / _norm(exact, basis.dx)


def error_of(problem: Manufactured, mesh: VentricularMesh, x: Floats) -> Errors:
    """Errors of the unknowns ``x`` (n, >= 3) on ``mesh``."""
    basis = quadrature(mesh)
    fields = [basis.interpolate(np.ascontiguousarray(x[:, i])) for i in range(3)]
    X = np.asarray(basis.global_coordinates())
    exact, gradient = problem.displacement(X), problem.displacement_gradient(X)
    value = np.stack([np.asarray(component) for component in fields]) - exact
    slope = np.stack([np.asarray(component.grad) for component in fields]) - gradient
    norms = [_norm(field, basis.dx) for field in (value, exact, slope, gradient)]
    return Errors(norms[0] / norms[1], norms[2] / norms[3])


def order(coarse: float, fine: float, refinement: float = 2.0) -> float:
    """Observed order of an error between meshes whose edges differ by the factor ``refinement``."""
    return float(np.log(coarse / fine) / np.log(refinement))


def _norm(field: Floats, dx: Floats) -> float:
    squares = (field**2).reshape(-1, *dx.shape).sum(axis=0)
    return float(np.sqrt((squares * dx).sum()))


SIZES = (3, 6, 12)
SOFT, USUAL, HARD = 3e4, 1e6, 1e7
"""Bulk moduli [Pa]; the shear modulus is 13.2 kPa."""

SOURCE = "element theory: order 2 in L2, 1 in H1"
PRESSURE = "stabilised equal order: at least 1 by theory, 2 on a regular mesh"


def block_checks() -> list[Check]:
    """Check the orders of ``p1`` without locking and of ``mixed`` at any K, and the growth of the error with K."""
    return [
        *_orders("p1", SOFT),
        *_orders("mixed", SOFT),
        *_orders("mixed", USUAL),
        *_orders("mixed", HARD),
        *_orders("p1", SOFT, PULLED),
        *_orders("mixed", USUAL, PULLED),
        Check("mixed: order in L2 of the pressure, K = 1e6 Pa", _pressure_order(), 2.0, 0.3, "1", PRESSURE),
        Check("mixed: L2 error, K = 1e7 over 1e6 Pa", growth("mixed"), 1.0, 0.03, "1", "no locking: 1"),
        Check(
            "p1: L2 error, K = 1e7 over 1e6 Pa",
            growth("p1"),
            1.6,
            0.3,
            "1",
            "a bound: locking keeps it well above 1",
        ),
        Check(
            "p1: order in L2, K = 1e7 Pa",
            _order("p1", HARD, "L2"),
            0.6,
            0.5,
            "1",
            "a bound: locking keeps it well below 2",
        ),
    ]


def growth(element: str) -> float:
    """Ratio of the L2 errors at the hard and the usual bulk modulus on the finest mesh."""
    return block_error(element, HARD, SIZES[-1]).L2 / block_error(element, USUAL, SIZES[-1]).L2


def block_error(element: str, K: float, n: int, pulled: Sides = ()) -> Errors:
    """Errors of the cube with ``n`` elements along an edge and bulk modulus ``K`` [Pa]."""
    return errors(Manufactured(MooneyRivlin(K=K)), n, element, pulled)


def _orders(element: str, K: float, pulled: Sides = ()) -> list[Check]:
    name = f"{element}: order in {{}}, K = {K:.0e} Pa".replace("e+0", "e") + (", traction" if pulled else "")
    return [
        Check(name.format("L2"), _order(element, K, "L2", pulled), 2.0, 0.2, "1", SOURCE),
        Check(name.format("H1"), _order(element, K, "H1", pulled), 1.0, 0.15, "1", SOURCE),
    ]


def _order(element: str, K: float, norm: str, pulled: Sides = ()) -> float:
    coarse, fine = (getattr(block_error(element, K, n, pulled), norm) for n in SIZES[-2:])
    return order(coarse, fine)


def _pressure_order() -> float:
    problem = Manufactured(MooneyRivlin(K=USUAL))
    return order(*(pressure_error(problem, n) for n in SIZES[-2:]))
