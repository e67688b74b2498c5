r"""The slab of the N-version benchmark of cardiac electrophysiology, for the eikonal solver.

A block of 20 x 7 x 3 mm with fibres along x is stimulated in a cube of 1.5 mm in one corner; asked for is the arrival
in the opposite corner, P8. With constant speeds v along and r v across the fibres rays are straight and the
closed form is

.. math:: t = \frac1v \sqrt{\Delta x^2 + (\Delta y^2 + \Delta z^2) / r^2}

from the nearest point of the cube. The benchmark itself solves a reaction-diffusion equation, whose front has no one
speed: an eikonal solver can be held to the closed form only, and compared with the benchmark in magnitude.
Source: Niederer et al., Phil. Trans. R. Soc. A 369 (2011) 4331.
"""

from functools import cache

import numpy as np
from skfem import MeshTet

from heartfit.core.arrays import Floats
from heartfit.heart.activation.eikonal import activation_times
from verification.block_checks import order
from verification.check import Check

SIZE = np.array([20e-3, 7e-3, 3e-3])
STIMULATED = 1.5e-3
SPEED, RATIO = 0.65, 0.28 / 0.65
"""Middle of the speeds along (0.6 to 0.7 m/s) and across (0.25 to 0.3 m/s) that suit the benchmark's tissue."""

CHASTE_CORNER = 36.30e-3
"""Arrival at P8, s, of one code of the benchmark on its coarsest mesh (0.5 mm); not the converged value."""


def slab(h: float, known: float = 0.0) -> tuple[Floats, Floats]:
    """Nodes (n, 3) and arrival times (n,) on a regular mesh of edge length ``h``, a divisor of the slab's edges.

    Within ``known`` (m) of the stimulated cube the exact times are given: where rays fan out from its edges, any
    solver of first order leaves an error of h log(1/h).
    """
    grid = MeshTet.init_tensor(*[np.linspace(0.0, side, round(side / h) + 1) for side in SIZE])
    points, tets = np.ascontiguousarray(grid.p.T), grid.t.T.astype(np.int64)
    fibres = np.tile([1.0, 0.0, 0.0], (len(tets), 1))
    near = np.flatnonzero(np.linalg.norm(np.maximum(points - STIMULATED, 0.0), axis=1) <= known + 1e-9)
    sites = dict(zip(near.tolist(), exact(points[near]).tolist(), strict=True))
    return points, activation_times(points, tets, fibres, sites, SPEED, RATIO)


def exact(points: Floats, speed: float = SPEED, ratio: float = RATIO) -> Floats:
    """Arrival times (n,) by the closed form."""
    away = np.maximum(points - STIMULATED, 0.0) / np.array([1.0, ratio, ratio])
    return np.linalg.norm(away, axis=1) / speed


@cache
def corner_error(h: float, known: float = 0.0) -> float:
    """By how much the wave is late at P8, over the exact arrival."""
    points, times = slab(h, known)
    corner = int(np.argmax(points.sum(axis=1)))
    return float(times[corner] / exact(points[corner : corner + 1])[0] - 1.0)


EDGES = (1e-3, 0.5e-3, 0.25e-3)
KNOWN = 3e-3


def slab_checks() -> list[Check]:
    """Lateness at P8 and its order, with and without the neighbourhood of the stimulus given."""
    near = [corner_error(h, KNOWN) for h in EDGES]
    bare = [corner_error(h) for h in EDGES[1:]]
    closed = "closed form of straight rays"
    return [
        Check("slab: P8 late, h = 0.25 mm", 100 * bare[1], 0.0, 2.0, "%", closed),
        Check("slab: order at P8", order(*bare), 0.75, 0.25, "1", "h log(1/h) at the stimulated cube"),
        Check("slab: P8 late, h = 0.25 mm, 3 mm given", 100 * near[2], 0.0, 1.0, "%", closed),
        Check("slab: order at P8, 3 mm given", order(*near[1:]), 1.0, 0.15, "1", "linear elements, order 1"),
    ]
