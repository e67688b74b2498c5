"""Whether ventricles are such that a heart could be made of them: whatever else a file of a mesh may hold."""

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.surface import LabelledSurface, enclosed_volume
from heartfit.geometry.topology import boundary_faces

WALLS = (2e-5, 2e-3)
"""Volumes of the wall of both ventricles, m^3, from a child's to far beyond the largest."""

CAVITIES = (5e-6, 1e-3)
"""Volumes of a ventricle, m^3, as for curves."""

SEGMENTS = 17
FARTHEST = 1e4
"""m from the origin, which a heart in mm does not reach."""

UNIT = 1e-2
"""By how much the length of a fibre may differ from one."""


def require_places(points: Floats) -> None:
    """Raises InputError unless all points (n,3) are somewhere near."""
    lost = np.flatnonzero(~(np.abs(points) < FARTHEST).all(axis=1))
    if len(lost):
        raise InputError(
            f"point {lost[0]} is {points[lost[0]].tolist()}; expected coordinates in m: build it again"
        )


def require_indices(points: Floats, *cells: Integers) -> None:
    """Raises InputError unless points are somewhere near and cells refer to them."""
    require_places(points)
    for each in cells:
        if each.size and not 0 <= each.min() <= each.max() < len(points):
            raise InputError(
                f"a cell refers to point {int(each.max())}; expected points 0 to {len(points) - 1}: build it again"
            )


def require_sound(mesh: VentricularMesh) -> None:
    """Raises InputError for inverted tetrahedra, a wall that no heart has, and surfaces and fields of no use."""
    volumes = mesh.element_volumes()
    inverted = np.flatnonzero(~(volumes > 0.0))
    if len(inverted):
        raise InputError(
            f"{len(inverted)} tetrahedra are inverted or flat, first tet {inverted[0]} with "
            f"{volumes[inverted[0]]:.3g} m^3; expected > 0; build the mesh again"
        )
    _require_volume("a wall", float(volumes.sum()), WALLS)
    _require_boundary(mesh)
    _require_fields(mesh)


def require_heart(surface: LabelledSurface, positions: Floats) -> None:
    """Raises InputError unless wall and cavities of a surface are of human size in every phase (p,n,3), m."""
    for phase, points in enumerate(positions):
        require_places(points)
        _require_volume(f"phase {phase}: a wall", enclosed_volume(points, surface.triangles), WALLS)
    for name in ("lv_endo", "rv_endo"):
        cavity = Cavity.of(surface, name)
        for phase, points in enumerate(positions):
            _require_volume(f"phase {phase}: a cavity {name}", cavity.volume(points), CAVITIES)


def _require_volume(what: str, volume: float, bounds: tuple[float, float]) -> None:
    low, high = bounds
    if low < volume < high:
        return
    factor = next((scale for scale in (1e3, 1e-3) if low < volume * scale**3 < high), None)
    hints = {1e3: "m taken for mm: convert it", 1e-3: "mm taken for m: convert it"}
    hint = "check the coordinates" if factor is None else hints[factor]
    raise InputError(f"{what} of {volume:.3g} m^3; expected {low:g} to {high:g} m^3; {hint}")


def _require_boundary(mesh: VentricularMesh) -> None:
    """The named surfaces are the boundary, each triangle once, normals out of the wall."""
    for name, triangles in mesh.surfaces.items():
        if not len(triangles):
            raise InputError(
                f"surface {name} has no triangle; expected the boundary of the wall: build it again"
            )
    named, boundary = (
        _turned(each) for each in (np.vstack(list(mesh.surfaces.values())), boundary_faces(mesh.tets))
    )
    if not np.array_equal(named, boundary):
        raise InputError(
            f"{len(named)} triangles of surfaces are not the {len(boundary)} of the tetrahedra's boundary, normals "
            "outwards; build it again"
        )


def _turned(triangles: Integers) -> Integers:
    """The triangles in order, each beginning with its least node."""
    first = triangles.argmin(axis=1)[:, None]
    turned = np.take_along_axis(triangles, (first + np.arange(3)) % 3, axis=1)
    return turned[np.lexsort(turned.T)]


def _require_fields(mesh: VentricularMesh) -> None:
    if mesh.fibres is not None and not (np.abs(np.linalg.norm(mesh.fibres, axis=1) - 1.0) < UNIT).all():
        raise InputError("fibres are not of length one; expected unit vectors: build it again")
    if mesh.segments is not None and not ((mesh.segments >= 0) & (mesh.segments <= SEGMENTS)).all():
        raise InputError(
            f"segments beyond 0 to {SEGMENTS}; expected those of the AHA, 0 on the right: build it again"
        )
    if mesh.activation is not None and not ((mesh.activation >= 0.0) & (mesh.activation < 1.0)).all():
        raise InputError("activation times beyond 0 to 1 s; expected seconds after the first: build it again")
    for name in ("longitudinal", "orientation"):
        field = getattr(mesh, name)
        if field is not None and not np.isfinite(field).all():
            raise InputError(f"{name} is not finite everywhere; expected numbers: build it again")
