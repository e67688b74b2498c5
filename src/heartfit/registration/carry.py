"""Carries the end-diastolic mesh through the beat."""

import numpy as np
from scipy.spatial import cKDTree

from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.laplace import harmonic_extension
from heartfit.geometry.mesh import VentricularMesh, element_volumes
from heartfit.geometry.motion import Motion
from heartfit.geometry.nearest import nearest_on_surface
from heartfit.geometry.surface import LabelledSurface


def carry_mesh(
    mesh: VentricularMesh, surface: LabelledSurface, phases: Floats, times: Floats, period: float
) -> Motion:
    """Carries the mesh by the surface that it fills, given the surface's points in every phase.

    phases (p,n,3) m, phases[0] = surface.points; times (p,) s; period s. A boundary node keeps its distance
    from the nearest point of the surface; inside, the displacement is harmonic. Phase 0 is the mesh itself.
    """
    nodes, triangles, weights = _attach(mesh, surface)
    moved = np.einsum("fc,pfcd->fpd", weights, (phases - phases[0])[:, triangles])
    displacement = harmonic_extension(mesh.points, mesh.tets, nodes, moved)
    return Motion(times, period, mesh.points + np.moveaxis(displacement, 1, 0))


def _attach(mesh: VentricularMesh, surface: LabelledSurface) -> tuple[Integers, Integers, Floats]:
    """Boundary nodes (f,), the surface triangle (f,3) nearest to each, barycentric coordinates (f,3) there.

    A node seeks only among triangles of its own name, because across a thin wall the other side may be
    nearer.
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


def follow_mesh(
    mesh: VentricularMesh, points: Floats, tets: Integers, positions: Floats, times: Floats, period: float
) -> Motion:
    """Carries a mesh by the motion of another, usually finer, one that fills the same wall.

    points (n,3) m: the other mesh where the two coincide; tets (m,4); positions (p,n,3) m in every phase. A
    node moves with the tetrahedron that holds it, or outside the wall with the nearest one. The displacement
    is taken from positions[0], so phase 0 is the mesh itself.
    """
    holder, weights = _locate(mesh.points, points, tets)
    moved = np.einsum("qc,pqcd->pqd", weights, (positions - positions[0])[:, tets[holder]])
    return Motion(times, period, mesh.points + moved)


def _locate(queries: Floats, points: Floats, tets: Integers, candidates: int = 40) -> tuple[Integers, Floats]:
    """The tetrahedron (q,) that holds each query, or nearly does, and barycentric coordinates (q,4)."""
    count = min(candidates, len(tets))
    near = np.asarray(cKDTree(points[tets].mean(axis=1)).query(queries, count)[1]).reshape(
        len(queries), count
    )
    a, b, c, d = np.moveaxis(points[tets[near]], 2, 0)
    local = np.linalg.solve(np.stack([b - a, c - a, d - a], axis=-1), (queries[:, None] - a)[..., None])[
        ..., 0
    ]
    weights = np.concatenate([1.0 - local.sum(axis=-1, keepdims=True), local], axis=-1)
    best = weights.min(axis=-1).argmax(axis=1)
    rows = np.arange(len(queries))
    inside = np.maximum(weights[rows, best], 0.0)
    return near[rows, best], inside / inside.sum(axis=1, keepdims=True)


def inverted_elements(mesh: VentricularMesh, motion: Motion) -> Integers:
    """How many tetrahedra are inverted in each phase (p,); cavity volumes do not see them."""
    volumes = [element_volumes(phase, mesh.tets) for phase in motion.positions]
    return (np.array(volumes) <= 0.0).sum(axis=1)


def boundary_surface(mesh: VentricularMesh, points: Floats) -> LabelledSurface:
    """The closed surface of a mesh whose nodes are at the points (n,3), to be filled anew."""
    faces = np.vstack(list(mesh.surfaces.values()))
    labels = np.repeat(list(mesh.surfaces), [len(part) for part in mesh.surfaces.values()])
    used, renumbered = np.unique(faces, return_inverse=True)
    return LabelledSurface(points[used], renumbered.reshape(faces.shape).astype(np.int64), labels)
