"""How far two places of one moving surface are apart, seen as shapes: what glides along itself has not moved."""

import numpy as np

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.nearest import nearest_on_surface


def surface_distances(first: Floats, second: Floats, triangles: Integers) -> tuple[Floats, Floats]:
    """Distances (2k,) in m from each of two surfaces to the other, and weights (2k,).

    first, second: points (n,3) m of the same triangles (k,3). Taken at the middle of each triangle; its weight is its
    share of its surface's area, halved: weighted means are means over both surfaces, however fine the triangles.
    """
    pairs = ((first, second), (second, first))
    distances = [_distance_to(other, one[triangles].mean(axis=1), triangles) for one, other in pairs]
    areas = [_areas(points[triangles]) for points in (first, second)]
    return np.concatenate(distances), np.concatenate([area / (2.0 * area.sum()) for area in areas])


def _distance_to(points: Floats, queries: Floats, triangles: Integers) -> Floats:
    triangle, weights = nearest_on_surface(queries, points, triangles)
    foot = np.einsum("qc,qcd->qd", weights, points[triangles[triangle]])
    distance: Floats = np.linalg.norm(foot - queries, axis=1)
    return distance


def _areas(corners: Floats) -> Floats:
    a, b, c = np.moveaxis(corners, 1, 0)
    area: Floats = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return area
