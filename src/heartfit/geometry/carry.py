"""Nearest points on a surface, distances between surfaces, and meshes that move with the surface that they fill."""

import numpy as np
from scipy.spatial import cKDTree

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.harmonic import harmonic_extension
from heartfit.geometry.mesh import Motion, VentricularMesh, element_volumes
from heartfit.geometry.surface import LabelledSurface, triangle_normals

CANDIDATES = 40
"""Triangles with the nearest centroids among which the nearest point is sought."""


def nearest_on_surface(
    queries: Floats, points: Floats, triangles: Integers, normals: Floats | None = None
) -> tuple[Integers, Floats]:
    """Return the nearest triangle (q,) and barycentric coordinates (q,3) of the nearest point on it, for queries (q,3).

    Among the CANDIDATES triangles with the nearest centroids. With normals (q,3) only triangles that face the
    same way (n.m > 0.2) count, so that a point on one side of a thin wall is never projected on the other side.
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
    """Return barycentric coordinates (...,3) of the point of a triangle (...,3,3) closest to its query (...,3)."""
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


def surface_distances(first: Floats, second: Floats, triangles: Integers) -> tuple[Floats, Floats]:
    """Return distances (2k,) [m] from each of two surfaces to the other, and weights (2k,).

    first, second: points (n,3) [m] of the same triangles (k,3). Distances are taken at the middle of each triangle; its
    weight is half its share of its surface's area, so weighted means are means over both surfaces, however fine the
    triangles.
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


def carry_mesh(
    mesh: VentricularMesh, surface: LabelledSurface, phases: Floats, times: Floats, period: float
) -> Motion:
    """Return the motion of a mesh that follows the surface it fills.

    phases (p,n,3) [m]: the surface's points, phases[0] = surface.points; times (p,) [s]; period [s]. A boundary
    node keeps its distance from the nearest point of the surface; inside, the displacement is harmonic. Phase 0 is the
    mesh itself.
    """
    return Motion(times, period, carry_nodes(mesh, surface, phases))


def carry_nodes(mesh: VentricularMesh, surface: LabelledSurface, phases: Floats) -> Floats:
    """Return positions (p,n,3) [m] of the mesh's nodes when its surface's points are at phases (p,s,3) [m]."""
    nodes, triangles, weights = _attach(mesh, surface)
    shift = np.einsum("fc,pfcd->fpd", weights, (phases - surface.points)[:, triangles])
    displacement = harmonic_extension(mesh.points, mesh.tets, nodes, shift)
    return mesh.points + np.moveaxis(displacement, 1, 0)


def _attach(mesh: VentricularMesh, surface: LabelledSurface) -> tuple[Integers, Integers, Floats]:
    """Return boundary nodes (f,), the surface triangle (f,3) nearest to each, barycentric coordinates (f,3) there.

    Only triangles of the node's own surface count, because across a thin wall the other side may be nearer.
    """
    nearest: dict[int, tuple[float, Integers, Floats]] = {}
    for name, faces in mesh.surfaces.items():
        nodes, triangles = np.unique(faces), surface.surfaces[name]
        index, weights = nearest_on_surface(mesh.points[nodes], surface.points, triangles)
        foot = np.einsum("fc,fcd->fd", weights, surface.points[triangles[index]])
        distance = np.linalg.norm(foot - mesh.points[nodes], axis=1)
        for i, node in enumerate(nodes.tolist()):
            if node not in nearest or distance[i] < nearest[node][0]:
                nearest[node] = (float(distance[i]), triangles[index[i]], weights[i])
    _, corner, weight = zip(*nearest.values(), strict=True)
    return np.array(list(nearest)), np.array(corner), np.array(weight)


def count_inverted_elements(mesh: VentricularMesh, motion: Motion) -> Integers:
    """Return the number (p,) of inverted tetrahedra in each phase; cavity volumes do not reveal them."""
    volumes = [element_volumes(phase, mesh.tets) for phase in motion.positions]
    return (np.array(volumes) <= 0.0).sum(axis=1)


def boundary_surface(mesh: VentricularMesh, points: Floats) -> LabelledSurface:
    """Return the closed surface of a mesh whose nodes are at the points (n,3) [m], for remeshing."""
    faces = np.vstack(list(mesh.surfaces.values()))
    labels = np.repeat(list(mesh.surfaces), [len(part) for part in mesh.surfaces.values()])
    used, renumbered = np.unique(faces, return_inverse=True)
    return LabelledSurface(points[used], renumbered.reshape(faces.shape).astype(np.int64), labels)
