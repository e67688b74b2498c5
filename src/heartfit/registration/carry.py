"""Carries a mesh by the surface that it fills: through the beat, or to another shape."""

import numpy as np

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
    return Motion(times, period, carry_nodes(mesh, surface, phases))


def carry_nodes(mesh: VentricularMesh, surface: LabelledSurface, phases: Floats) -> Floats:
    """The places (p,n,3) m of the mesh's nodes where its surface's points are at phases (p,s,3) m."""
    nodes, triangles, weights = _attach(mesh, surface)
    moved = np.einsum("fc,pfcd->fpd", weights, (phases - surface.points)[:, triangles])
    displacement = harmonic_extension(mesh.points, mesh.tets, nodes, moved)
    return mesh.points + np.moveaxis(displacement, 1, 0)


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
