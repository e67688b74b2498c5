"""Fills the wall with tetrahedra and recovers the names of its surfaces.

The mesher is fTetWild (Hu et al. 2020, doi 10.1145/3386569.3392385). It draws random numbers that cannot be
seeded, so two calls give two different meshes of the same quality: what is computed on a mesh repeats only on
the stored mesh.
"""

import os
from collections import Counter
from collections.abc import Iterator
from contextlib import chdir, contextmanager
from tempfile import TemporaryDirectory

import numpy as np
import wildmeshing

from heartfit.geometry.arrays import Floats, Integers, Names
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.nearest import nearest_on_surface
from heartfit.geometry.quality import SMALLEST_ANGLE, defect_of
from heartfit.geometry.surface import SURFACES, LabelledSurface, triangle_normals
from heartfit.geometry.topology import boundary_faces, neighbours

ATTEMPTS = 12


class MeshingError(RuntimeError):
    """The wall could not be filled with tetrahedra that are good enough to compute on."""


def fill_wall(
    surface: LabelledSurface, edge_length: float, tolerance: float, smallest_angle: float = SMALLEST_ANGLE
) -> VentricularMesh:
    """Tetrahedra of the wall inside the surface, with the surface's names on their boundary.

    edge_length: wished edge length in m; tolerance: how far in m the boundary may leave the surface;
    smallest_angle: between two faces, rad. Raises MeshingError when in ATTEMPTS meshes the wall volume is off by
    more than 2 %, an angle is smaller, or a valve ring is pinched.
    """
    defects = []
    for _ in range(ATTEMPTS):
        points, tets = _tetrahedralise(surface, edge_length, tolerance)
        mesh = VentricularMesh(points, tets, _name_surfaces(surface, points, boundary_faces(tets)))
        defect = defect_of(mesh, surface, smallest_angle)
        if not defect:
            return mesh
        defects.append(defect)
    raise MeshingError(
        f"edge length {edge_length * 1e3:g} mm, tolerance {tolerance * 1e3:g} mm: {ATTEMPTS} bad meshes: "
        f"{'; '.join(defects)}; use a shorter edge length or a smaller tolerance"
    )


def _tetrahedralise(
    surface: LabelledSurface, edge_length: float, tolerance: float
) -> tuple[Floats, Integers]:
    scale = surface.diagonal()
    with _silent_output(), TemporaryDirectory() as scratch, chdir(scratch):
        mesher = wildmeshing.Tetrahedralizer(
            epsilon=tolerance / scale, edge_length_r=edge_length / scale, coarsen=True, max_threads=1
        )
        mesher.set_log_level(6)
        mesher.set_mesh(surface.points / scale, surface.triangles.astype(np.int32))
        mesher.tetrahedralize()
        points, tets, _ = mesher.get_tet_mesh(manifold_surface=True)
    return points * scale, _positively_oriented(points, tets.astype(np.int64))


def _positively_oriented(points: Floats, tets: Integers) -> Integers:
    a, b, c, d = points[tets.T]
    negative = np.einsum("ij,ij->i", b - a, np.cross(c - a, d - a)) < 0.0
    tets[negative] = tets[negative][:, [0, 2, 1, 3]]
    return tets


@contextmanager
def _silent_output() -> Iterator[None]:
    """Discards what compiled code writes to the standard output, which Python's redirection cannot reach."""
    saved, sink = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(sink, 1)
    try:
        yield
    finally:
        os.dup2(saved, 1)
        os.close(saved)
        os.close(sink)


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
