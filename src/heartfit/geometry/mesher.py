"""Reproducible tetrahedral meshes of the wall, with the names of its surfaces on their boundary."""

from collections import Counter

from heartfit.core.arrays import Floats, Integers, Names
from heartfit.geometry.carry import nearest_on_surface
from heartfit.geometry.mesh import SMALLEST_ANGLE, VentricularMesh, find_defect
from heartfit.geometry.surface import SURFACES, LabelledSurface, boundary_faces, neighbours, triangle_normals
from heartfit.geometry.tetrahedra import tetrahedralise

ATTEMPTS = 12
"""Seeds to try before a wall is given up."""


class MeshingError(RuntimeError):
    """The wall could not be filled with tetrahedra that are good enough to compute on."""


def fill_wall(
    surface: LabelledSurface,
    edge_length: float,
    tolerance: float,
    smallest_angle: float = SMALLEST_ANGLE,
    attempts: int = ATTEMPTS,
) -> VentricularMesh:
    """Fill the surface with tetrahedra, with the surface's names on their boundary.

    edge_length: target edge length [m]; tolerance: largest distance [m] of the boundary from the surface;
    smallest_angle: between two faces [rad]. Raises MeshingError when in all attempts the wall volume is off by
    more than 2 %, an angle is smaller, or a valve ring is pinched. It also raises MeshingError when the mesher crashes,
    as with a tolerance as wide as the wall; it then tries no other seed, because a machine that lacks memory would
    crash again.
    """
    sizes, advice = _sizes_in_mm(edge_length, tolerance), "use a shorter edge length or a smaller tolerance"
    defects = []
    for seed in range(attempts):
        try:
            points, tets = tetrahedralise(surface, edge_length, tolerance, seed)
        except ChildProcessError as crash:
            raise MeshingError(f"{sizes}: {crash}; {advice}") from None
        mesh = VentricularMesh(points, tets, _name_surfaces(surface, points, boundary_faces(tets)))
        defect = find_defect(mesh, surface, smallest_angle)
        if not defect:
            return mesh
        defects.append(defect)
    raise MeshingError(f"{sizes}: {attempts} bad meshes: {'; '.join(dict.fromkeys(defects))}; {advice}")


def _sizes_in_mm(edge_length: float, tolerance: float) -> str:
    return f"edge length {edge_length * 1e3:g} mm, tolerance {tolerance * 1e3:g} mm"


def _name_surfaces(surface: LabelledSurface, points: Floats, faces: Integers) -> dict[str, Integers]:
    """Give each boundary face the name of the nearest triangle that faces the same way."""
    nearest, _ = nearest_on_surface(
        points[faces].mean(axis=1), surface.points, surface.triangles, triangle_normals(points, faces)
    )
    labels = _remove_islands(surface.labels[nearest], neighbours(faces))
    return {name: faces[labels == name] for name in SURFACES}


def _remove_islands(labels: Names, pairs: Integers) -> Names:
    """Rename each face at most one of whose neighbours has its name and two of which agree on another."""
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
