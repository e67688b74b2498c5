r"""Structured tetrahedra for the problems of Land et al.: half a beam and a truncated ellipsoid.

The ventricle is the wall between the ellipsoids of half-axes

.. math:: r_s = 7 + 3 t, \quad r_l = 17 + 3 t \text{ (mm)}, \qquad
          x = (r_s \sin w \cos v,\ r_s \sin w \sin v,\ -r_l \cos w), \qquad 0 \le t \le 1,

cut at z = 5 mm; w = 0 is the apex. Rings of constant w around the apex are joined by triangles, these are extruded
across the wall and cut into three tetrahedra each. Fibres turn from +90 degrees at t = 0 to -90 degrees at t = 1 about
the normal, counted from the parallel to the meridian, and are taken at the centroid.
"""

import numpy as np
from skfem import MeshTet

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.topology import boundary_faces
from heartfit.verification.grids import named, oriented

MM = 1e-3
BASE = 5.0 * MM
WALL = 3.0 * MM


def half_beam(n_x: int, n_y: int, n_z: int) -> VentricularMesh:
    """10 x 0.5 x 1 mm, fibres along x, elements shorter towards the clamp at x = 0; ``lv_endo`` is the bottom."""
    axes = (10.0 * np.linspace(0.0, 1.0, n_x + 1) ** 1.5, np.linspace(0.0, 0.5, n_y + 1))
    grid = MeshTet.init_tensor(*(MM * axis for axis in axes), MM * np.linspace(0.0, 1.0, n_z + 1))
    points, tets = np.ascontiguousarray(grid.p.T), grid.t.T.astype(np.int64)
    tets = oriented(points, tets)
    shell = boundary_faces(tets)
    centres = points[shell].mean(axis=1) / MM
    places = {"lv_endo": (2, 0.0), "rv_endo": (2, 1.0), "base": (0, 0.0), "epi": (0, 10.0)}
    surfaces = {name: shell[np.isclose(centres[:, axis], at)] for name, (axis, at) in places.items()}
    return named(points, tets, surfaces, np.tile([1.0, 0.0, 0.0], (len(tets), 1)))


def ventricle(rings: int, sextant: int, layers: int, refined: float = 1.0) -> VentricularMesh:
    """The truncated ellipsoid with ``layers`` across the wall and ``rings`` from apex to base.

    Up to ring ``sextant`` each has six nodes more than the one before. ``refined`` > 1 crowds rings at the apex
    and layers at the endocardium. The apices are the first node of the first and of the last layer; ``rv_endo``
    is the epicardium once more: there is no second cavity.
    """
    ring, angle, triangles = _disc(rings, sextant)
    depths = np.linspace(0.0, 1.0, layers + 1) ** refined
    points = np.concatenate([_layer(t, (ring / rings) ** refined, angle) for t in depths])
    tets = oriented(points, _extruded(triangles, len(ring), layers))
    fibres = fibre_direction(points[tets].mean(axis=1), np.repeat(depths, len(ring))[tets].mean(axis=1))
    return named(points, tets, _surfaces(tets, ring, layers), fibres)


def fibre_direction(points: Floats, depth: Floats) -> Floats:
    """Unit fibres (m, 3) at points (m, 3) of the transmural coordinate ``depth`` (m,)."""
    r_s, r_l = 7.0 * MM + WALL * depth, 17.0 * MM + WALL * depth
    v = np.arctan2(points[:, 1], points[:, 0])
    w = np.arctan2(np.hypot(points[:, 0], points[:, 1]) / r_s, -points[:, 2] / r_l)
    meridian = np.stack([r_s * np.cos(w) * np.cos(v), r_s * np.cos(w) * np.sin(v), r_l * np.sin(w)])
    parallel, angle = np.stack([-np.sin(v), np.cos(v), np.zeros_like(v)]), 0.5 * np.pi * (1.0 - 2.0 * depth)
    fibres: Floats = np.sin(angle) * meridian / np.linalg.norm(meridian, axis=0) + np.cos(angle) * parallel
    return fibres.T


def _layer(t: float, latitude: Floats, angle: Floats) -> Floats:
    r_s, r_l = 7.0 * MM + WALL * t, 17.0 * MM + WALL * t
    w = latitude * (np.pi - np.arccos(BASE / r_l))
    return np.column_stack(
        [r_s * np.sin(w) * np.cos(angle), r_s * np.sin(w) * np.sin(angle), -r_l * np.cos(w)]
    )


def _disc(rings: int, sextant: int) -> tuple[Integers, Floats, Integers]:
    """Ring (n,) and angle (n,) of the nodes of a disc, its centre first, and its triangles (k, 3)."""
    counts = np.array([1] + [6 * min(k, sextant) for k in range(1, rings + 1)])
    starts = np.cumsum(counts) - counts
    angle = np.concatenate([2.0 * np.pi * np.arange(count) / count for count in counts])
    strips = [_strip(starts[k], counts[k], starts[k + 1], counts[k + 1]) for k in range(rings)]
    return np.repeat(np.arange(rings + 1), counts), angle, np.concatenate(strips)


def _strip(inner: int, a: int, outer: int, b: int) -> Integers:
    """Triangles between a ring of ``a`` nodes from ``inner`` on and one of ``b`` nodes from ``outer`` on."""
    triangles, i, j = [], 0, 0
    steps = a if a > 1 else 0
    while i < steps or j < b:
        here = inner + i % a, outer + j % b
        if j < b and (i >= steps or (j + 1) * a <= (i + 1) * b):
            j += 1
            triangles.append((*here, outer + j % b))
        else:
            i += 1
            triangles.append((*here, inner + i % a))
    return np.array(triangles)


def _extruded(triangles: Integers, nodes: int, layers: int) -> Integers:
    """Prisms cut alike on both sides of each face, since their corners are taken in the order of the nodes."""
    a, b, c = np.sort(triangles, axis=1).T
    prism = np.stack(
        [[a, b, c, c + nodes], [a, b, b + nodes, c + nodes], [a, a + nodes, b + nodes, c + nodes]]
    )
    once = prism.transpose(0, 2, 1).reshape(-1, 4)
    return np.concatenate([once + nodes * layer for layer in range(layers)]).astype(np.int64)


def _surfaces(tets: Integers, ring: Integers, layers: int) -> dict[str, Integers]:
    shell = boundary_faces(tets)
    layer, place = np.divmod(shell, len(ring))
    endo, epi = (layer == 0).all(axis=1), (layer == layers).all(axis=1)
    base = (ring[place] == ring.max()).all(axis=1)
    return {"lv_endo": shell[endo], "rv_endo": shell[epi], "epi": shell[epi], "base": shell[base]}
