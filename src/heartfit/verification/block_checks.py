"""Orders of the two elements on the manufactured deformation, and whether they lock."""

from heartfit.mechanics.passive.mooney_rivlin import MooneyRivlin
from heartfit.verification.block import PULLED, Sides
from heartfit.verification.check import Check
from heartfit.verification.convergence import Errors, errors, order, pressure_error
from heartfit.verification.manufactured import Manufactured

SIZES = (3, 6, 12)
SOFT, USUAL, HARD = 3e4, 1e6, 1e7
"""Bulk moduli, Pa; the shear modulus is 13.2 kPa."""

SOURCE = "element theory: order 2 in L2, 1 in H1"
PRESSURE = "stabilised equal order: at least 1 by theory, 2 on a regular mesh"


def block_checks() -> list[Check]:
    """Orders, ``p1`` where it does not lock and ``mixed`` at any K; growth of the error with K on the finest mesh."""
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
    """L2 error at the hard over that at the usual bulk modulus, finest mesh."""
    return block_error(element, HARD, SIZES[-1]).L2 / block_error(element, USUAL, SIZES[-1]).L2


def block_error(element: str, K: float, n: int, pulled: Sides = ()) -> Errors:
    """Errors of the cube with ``n`` elements along an edge and bulk modulus ``K`` (Pa)."""
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
