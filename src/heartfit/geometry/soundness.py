"""Checks that a mesh or surface can be the wall of human ventricles."""

import numpy as np

from heartfit.core.arrays import Floats, Integers
from heartfit.core.errors import InputError
from heartfit.geometry.cavity import Cavity
from heartfit.geometry.mesh import VentricularMesh
from heartfit.geometry.surface import LabelledSurface, boundary_faces, enclosed_volume
from heartfit.geometry.territory import APEX

WALL_VOLUMES = (2e-5, 2e-3)
"""Bounds [m^3] of the wall volume of both ventricles, from a child's to far beyond the largest."""

CAVITY_VOLUMES = (5e-6, 1e-3)
"""Bounds [m^3] of a cavity volume, as for curves."""

LARGEST_COORDINATE = 1e4
"""Distance [m] from the origin that even coordinates in mm do not reach."""

FIBRE_LENGTH_TOLERANCE = 1e-2
"""Largest deviation of the length of a fibre from one."""


def require_places(points: Floats) -> None:
    """Raise InputError unless all points (n,3) are within LARGEST_COORDINATE of the origin."""
    distant = np.flatnonzero(~(np.abs(points) < LARGEST_COORDINATE).all(axis=1))
    if len(distant):
        raise InputError(
            f"point {distant[0]} is {points[distant[0]].tolist()}; expected coordinates in m: build it again"
        )


def require_indices(points: Floats, *cells: Integers) -> None:
    """Raise InputError unless points pass :func:`require_places` and cells refer to them."""
    require_places(points)
    for indices in cells:
        if indices.size and not 0 <= indices.min() <= indices.max() < len(points):
            raise InputError(
                f"a cell refers to point {int(indices.max())}; expected points 0 to {len(points) - 1}: build it again"
            )


def require_sound(mesh: VentricularMesh) -> None:
    """Raise InputError for inverted tetrahedra, a wall of no human size, a wrong boundary or inadmissible fields."""
    volumes = mesh.element_volumes()
    inverted = np.flatnonzero(~(volumes > 0.0))
    if len(inverted):
        raise InputError(
            f"{len(inverted)} tetrahedra are inverted or flat, first tet {inverted[0]} with "
            f"{volumes[inverted[0]]:.3g} m^3; expected > 0; build the mesh again"
        )
    _require_volume("a wall", float(volumes.sum()), WALL_VOLUMES)
    _require_boundary(mesh)
    _require_fields(mesh)


def require_heart(surface: LabelledSurface, positions: Floats) -> None:
    """Raise InputError unless wall and cavities of a surface are of human size in every phase (p,n,3) [m]."""
    for phase, points in enumerate(positions):
        require_places(points)
        _require_volume(f"phase {phase}: a wall", enclosed_volume(points, surface.triangles), WALL_VOLUMES)
    for name in ("lv_endo", "rv_endo"):
        cavity = Cavity.from_endocardium(surface, name)
        for phase, points in enumerate(positions):
            _require_volume(f"phase {phase}: a cavity {name}", cavity.volume(points), CAVITY_VOLUMES)


def _require_volume(what: str, volume: float, bounds: tuple[float, float]) -> None:
    low, high = bounds
    if low < volume < high:
        return
    factor = next((scale for scale in (1e3, 1e-3) if low < volume * scale**3 < high), None)
    hints = {1e3: "m taken for mm: convert it", 1e-3: "mm taken for m: convert it"}
    hint = "check the coordinates" if factor is None else hints[factor]
    raise InputError(f"{what} of {volume:.3g} m^3; expected {low:g} to {high:g} m^3; {hint}")


def _require_boundary(mesh: VentricularMesh) -> None:
    """Raise InputError unless the named surfaces are the boundary, each triangle once, normals out of the wall."""
    for name, triangles in mesh.surfaces.items():
        if not len(triangles):
            raise InputError(
                f"surface {name} has no triangle; expected the boundary of the wall: build it again"
            )
    named, boundary = (
        _canonical_order(triangles)
        for triangles in (np.vstack(list(mesh.surfaces.values())), boundary_faces(mesh.tets))
    )
    if not np.array_equal(named, boundary):
        raise InputError(
            f"{len(named)} triangles of surfaces are not the {len(boundary)} of the tetrahedra's boundary, normals "
            "outwards; build it again"
        )


def _canonical_order(triangles: Integers) -> Integers:
    """Return the sorted triangles (k,3), each beginning with its least node."""
    first = triangles.argmin(axis=1)[:, None]
    turned = np.take_along_axis(triangles, (first + np.arange(3)) % 3, axis=1)
    return turned[np.lexsort(turned.T)]


def _require_fields(mesh: VentricularMesh) -> None:
    if (
        mesh.fibres is not None
        and not (np.abs(np.linalg.norm(mesh.fibres, axis=1) - 1.0) < FIBRE_LENGTH_TOLERANCE).all()
    ):
        raise InputError("fibres are not of length one; expected unit vectors: build it again")
    if mesh.segments is not None and not ((mesh.segments >= 0) & (mesh.segments <= APEX)).all():
        raise InputError(
            f"segments beyond 0 to {APEX}; expected those of the AHA, 0 on the right: build it again"
        )
    if mesh.activation is not None and not ((mesh.activation >= 0.0) & (mesh.activation < 1.0)).all():
        raise InputError("activation times beyond 0 to 1 s; expected seconds after the first: build it again")
    for name in ("longitudinal", "orientation"):
        field = getattr(mesh, name)
        if field is not None and not np.isfinite(field).all():
            raise InputError(f"{name} is not finite everywhere; expected numbers: build it again")
