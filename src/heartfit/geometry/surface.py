"""A closed surface of the wall whose triangles carry the name of the region they belong to."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers, Names
from heartfit.geometry.topology import directed_edges

SURFACES = ("lv_endo", "rv_endo", "epi", "base")


def enclosed_volume(points: Floats, triangles: Integers) -> float:
    """Volume in m^3 inside a closed surface, V = 1/6 sum a.(b x c), positive for outward normals."""
    a, b, c = points[triangles.T]
    return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)


def triangle_normals(points: Floats, triangles: Integers) -> Floats:
    """Unit normals (k,3) by the right-hand rule."""
    a, b, c = points[triangles.T]
    normal = np.cross(b - a, c - a)
    return normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), np.finfo(float).tiny)


@dataclass(frozen=True, eq=False)
class LabelledSurface:
    """The closed surface of the wall, normals pointing out of it.

    points (n,3) m; triangles (k,3) int64; labels (k,) each one of SURFACES.
    Raises InputError when an edge does not belong to exactly two triangles that agree in orientation,
    when the normals point inwards, or when a label is not one of SURFACES.
    """

    points: Floats
    triangles: Integers
    labels: Names

    def __post_init__(self) -> None:
        unknown = sorted(set(self.labels.tolist()) - set(SURFACES))
        if unknown:
            raise InputError(f"surface labels {unknown} are unknown; expected only {', '.join(SURFACES)}")
        require_closed(self.triangles)
        volume = enclosed_volume(self.points, self.triangles)
        if not volume > 0.0:
            raise InputError(f"surface encloses {volume:.3g} m^3; expected > 0; turn the triangles outwards")

    @cached_property
    def surfaces(self) -> Mapping[str, Integers]:
        """Triangles by name."""
        return {name: self.triangles[self.labels == name] for name in SURFACES}

    def volume(self) -> float:
        """Wall volume in m^3."""
        return enclosed_volume(self.points, self.triangles)

    def diagonal(self) -> float:
        """Length in m of the diagonal of the bounding box."""
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))


def require_closed(triangles: Integers) -> None:
    """Raises InputError unless every edge is run through once in each sense."""
    edges = directed_edges(triangles)
    directed, count = np.unique(edges, axis=0, return_counts=True)
    present = set(map(tuple, directed.tolist()))
    single = [edge for edge in present if edge[::-1] not in present]
    if single:
        raise InputError(
            f"surface is not closed or not consistently oriented: {len(single)} edges "
            f"have one side only, for example nodes {single[0]}; expected two triangles at every edge; "
            "close the hole or turn the triangles"
        )
    if (count > 1).any():
        raise InputError(
            f"surface is not a manifold: {int((count > 1).sum())} edges are run through more than once "
            f"in the same sense, for example nodes {tuple(directed[count > 1][0].tolist())}; "
            "expected one triangle on each side"
        )
