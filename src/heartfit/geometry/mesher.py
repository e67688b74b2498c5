"""Fills the wall with tetrahedra and recovers the names of its surfaces: the same mesh for the same surface."""

from collections import Counter

from heartfit.geometry.arrays import Floats, Integers, Names
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.nearest import nearest_on_surface
from heartfit.geometry.quality import SMALLEST_ANGLE, defect_of
from heartfit.geometry.surface import SURFACES, LabelledSurface, triangle_normals
from heartfit.geometry.tetrahedra import tetrahedralise
from heartfit.geometry.topology import boundary_faces, neighbours

ATTEMPTS = 12


class MeshingError(RuntimeError):
    """The wall could not be filled with tetrahedra that are good enough to compute on."""


def fill_wall(
    surface: LabelledSurface,
    edge_length: float,
    tolerance: float,
    smallest_angle: float = SMALLEST_ANGLE,
    attempts: int = ATTEMPTS,
) -> VentricularMesh:
    """Tetrahedra of the wall inside the surface, with the surface's names on their boundary.

    edge_length: wished edge length in m; tolerance: how far in m the boundary may leave the surface;
    smallest_angle: between two faces, rad. Raises MeshingError when in all attempts the wall volume is off by
    more than 2 %, an angle is smaller, or a valve ring is pinched, and where the mesher itself ends in a crash, as with
    a tolerance as wide as the wall: no other seed is tried then, which a machine that lacks memory would take.
    """
    asked, advice = _in_mm(edge_length, tolerance), "use a shorter edge length or a smaller tolerance"
    defects = []
    for seed in range(attempts):
        try:
            points, tets = tetrahedralise(surface, edge_length, tolerance, seed)
        except ChildProcessError as crash:
            raise MeshingError(f"{asked}: {crash}; {advice}") from None
        mesh = VentricularMesh(points, tets, _name_surfaces(surface, points, boundary_faces(tets)))
        defect = defect_of(mesh, surface, smallest_angle)
        if not defect:
            return mesh
        defects.append(defect)
    raise MeshingError(f"{asked}: {attempts} bad meshes: {'; '.join(dict.fromkeys(defects))}; {advice}")


def _in_mm(edge_length: float, tolerance: float) -> str:
    return f"edge length {edge_length * 1e3:g} mm, tolerance {tolerance * 1e3:g} mm"


def _name_surfaces(surface: LabelledSurface, points: Floats, faces: Integers) -> dict[str, Integers]:
    """Each boundary face takes the name of the nearest triangle that faces the same way."""
    nearest, _ = nearest_on_surface(
        points[faces].mean(axis=1), surface.points, surface.triangles, triangle_normals(points, faces)
    )
    labels = _without_islands(surface.labels[nearest], neighbours(faces))
    return {name: faces[labels == name] for name in SURFACES}


def _without_islands(labels: Names, pairs: Integers) -> Names:
    """A face whose neighbours mostly agree on another name, and at most one on its own, takes theirs."""
    adjacent: list[list[int]] = [[] for _ in labels]
    for a, b in pairs.tolist():
        adjacent[a].append(b)
        adjacent[b].append(a)
    labels = labels.copy()
    for _ in range(3):
        for face, around in enumerate(adjacent):
            name, count = Counter(labels[around].tolist()).most_common(1)[0]
            if count >= 2 and name != labels[face]:
                labels[face] = name
    return labels
