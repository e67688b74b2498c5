"""Where on a triangulated surface a point lies nearest."""

import numpy as np
from scipy.spatial import cKDTree

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.surface import triangle_normals

CANDIDATES = 40


def nearest_on_surface(
    queries: Floats, points: Floats, triangles: Integers, normals: Floats | None = None
) -> tuple[Integers, Floats]:
    """Nearest triangle (q,) and barycentric coordinates (q,3) of the nearest point on it, for queries (q,3).

    Among the CANDIDATES triangles with the nearest centroids. With normals (q,3) only triangles that face the
    same way (n.m > 0.2) count, so that a point on one side of a thin wall never finds the other side.
    """
    count = min(CANDIDATES, len(triangles))
    _, candidate = cKDTree(points[triangles].mean(axis=1)).query(queries, count)
    candidate = np.asarray(candidate).reshape(len(queries), count)
    weights = closest_weights(queries[:, None], points[triangles[candidate]])
    foot = np.einsum("qkc,qkcd->qkd", weights, points[triangles[candidate]])
    distance = np.linalg.norm(foot - queries[:, None], axis=2)
    if normals is not None:
        facing = np.einsum("qkd,qd->qk", triangle_normals(points, triangles)[candidate], normals)
        distance = np.where(facing > 0.2, distance, distance + 1e3)
    best = distance.argmin(axis=1)
    rows = np.arange(len(queries))
    return candidate[rows, best], weights[rows, best]


def closest_weights(queries: Floats, corners: Floats) -> Floats:
    """Barycentric coordinates (...,3) of the point of a triangle (...,3,3) closest to its query (...,3)."""
    inside = _plane_weights(queries, corners)
    options = [np.where((inside >= 0).all(axis=-1, keepdims=True), inside, np.nan)]
    options += [_edge_weights(queries, corners, i, (i + 1) % 3) for i in range(3)]
    weights = np.stack(options, axis=-2)
    foot = np.einsum("...oc,...cd->...od", weights, corners)
    distance = np.linalg.norm(foot - queries[..., None, :], axis=-1)
    best = np.nanargmin(distance, axis=-1)
    return np.take_along_axis(weights, best[..., None, None], axis=-2)[..., 0, :]


def _plane_weights(queries: Floats, corners: Floats) -> Floats:
    """Barycentric coordinates of the projection on the triangle's plane."""
    a, b, c = np.moveaxis(corners, -2, 0)
    normal = np.cross(b - a, c - a)
    square = np.maximum((normal**2).sum(axis=-1), np.finfo(float).tiny)
    second = (np.cross(queries - a, c - a) * normal).sum(axis=-1) / square
    third = (np.cross(b - a, queries - a) * normal).sum(axis=-1) / square
    return np.stack([1.0 - second - third, second, third], axis=-1)


def _edge_weights(queries: Floats, corners: Floats, i: int, j: int) -> Floats:
    """Barycentric coordinates of the closest point on the edge from corner i to corner j."""
    edge = corners[..., j, :] - corners[..., i, :]
    square = np.maximum((edge**2).sum(axis=-1), np.finfo(float).tiny)
    along = np.clip(((queries - corners[..., i, :]) * edge).sum(axis=-1) / square, 0.0, 1.0)
    weights = np.zeros((*along.shape, 3))
    weights[..., i], weights[..., j] = 1.0 - along, along
    return weights
