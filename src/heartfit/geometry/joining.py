"""Closed surface of the wall, from endocardia and epicardium that are open at the base.

Two kinds of epicardium are accepted. Either it reaches the valve rings: its openings are those of the endocardia, node
for node, and its triangles at these rings are the base. Or it has one opening around those of both endocardia, one in
each: the base is the plane part between the three rings, triangulated by Mapbox's earcut.
"""

from collections.abc import Mapping

import numpy as np
from scipy.spatial import cKDTree

from heartfit.core.arrays import Floats, Integers, Names
from heartfit.core.errors import InputError
from heartfit.geometry.surface import LabelledSurface, enclosed_volume, orient, rim_loops

OPEN_SURFACES = ("lv_endo", "rv_endo", "epi")
RING_TOLERANCE, SEAM_TOLERANCE = 1e-6, 1e-8
"""Distances [m] below which nodes of two rings, and nodes of one surface, coincide."""

LARGEST_DEVIATION_FROM_PLANE = 0.25
"""Largest deviation of the rings of a base from their common plane, over the radius of the outer one."""


def weld_surfaces(points: Floats, triangles: Mapping[str, Integers]) -> LabelledSurface:
    """Return the closed surface of the triangles (k,3) of lv_endo, rv_endo and epi; it keeps the points (n,3) [m].

    Raises InputError unless rings coincide or lie around each other in a plane.
    """
    parts = {name: orient(_merge_coincident_nodes(points, triangles[name])) for name in OPEN_SURFACES}
    rings = {name: rim_loops(parts[name]) for name in OPEN_SURFACES}
    for name in OPEN_SURFACES:
        if not rings[name]:
            raise InputError(f"surface {name} has no opening; expected one at the base: leave the valves out")
    inner, outer = np.concatenate([*rings["lv_endo"], *rings["rv_endo"]]), np.concatenate(rings["epi"])
    distance, nearest = cKDTree(points[inner]).query(points[outer])
    if (distance < RING_TOLERANCE).all():
        parts["epi"] = _substitute_nodes(parts["epi"], outer, inner[nearest])
        faces, labels = _stack_parts(parts)
        labels[(labels == "epi") & np.isin(faces, inner).any(axis=1)] = "base"
        return orient_outwards(points, faces, labels)
    faces, labels = _stack_parts(parts | {"base": _triangulate_base(points, rings)})
    return orient_outwards(points, faces, labels)


def orient_outwards(points: Floats, triangles: Integers, labels: Names) -> LabelledSurface:
    """Return the labelled surface with outward normals; raises InputError if it is not closed."""
    faces = orient(triangles)
    return LabelledSurface(points, faces if enclosed_volume(points, faces) > 0.0 else faces[:, ::-1], labels)


def _merge_coincident_nodes(points: Floats, triangles: Integers) -> Integers:
    """Return the triangles (k,3) with coincident nodes, as along seams of patches, replaced by the first of them."""
    nodes = np.unique(triangles)
    first = np.arange(len(points))
    for a, b in sorted(cKDTree(points[nodes]).query_pairs(SEAM_TOLERANCE)):
        first[nodes[b]] = first[nodes[a]]
    return first[triangles]


def _substitute_nodes(triangles: Integers, nodes: Integers, others: Integers) -> Integers:
    """Return the triangles (k,3) with nodes (n,) replaced by others (n,)."""
    new = np.arange(int(triangles.max()) + 1)
    new[nodes] = others
    return new[triangles]


def _stack_parts(parts: Mapping[str, Integers]) -> tuple[Integers, Names]:
    labels = np.repeat(list(parts), [len(part) for part in parts.values()])
    return np.vstack(list(parts.values())), labels.astype("<U8")


def _triangulate_base(points: Floats, rings: Mapping[str, list[Integers]]) -> Integers:
    """Return the triangles between one ring of the epicardium and one of each endocardium inside it.

    Raises InputError unless each surface has one opening.
    """
    from mapbox_earcut import triangulate_float64

    counts = {name: len(rings[name]) for name in OPEN_SURFACES}
    if set(counts.values()) != {1}:
        openings = ", ".join(f"{name} {count}" for name, count in counts.items())
        raise InputError(
            f"surfaces: openings {openings}; expected one of each around the base, or an epicardium that reaches the "
            "valve rings node for node: cut the surfaces by one plane, or give one closed surface with labels"
        )
    loops = [rings[name][0] for name in ("epi", "lv_endo", "rv_endo")]
    flat = _in_plane(points, loops)
    ends = np.cumsum([len(loop) for loop in loops]).astype(np.uint32)
    triangles: Integers = np.concatenate(loops)[triangulate_float64(flat, ends)].reshape(-1, 3)
    return triangles


def _in_plane(points: Floats, loops: list[Integers]) -> Floats:
    """Return coordinates (r,2) of the rings' nodes in the plane of the outer ring.

    Raises InputError if the rings leave that plane by more than LARGEST_DEVIATION_FROM_PLANE.
    """
    outer = points[loops[0]]
    centre = outer.mean(axis=0)
    _, _, axes = np.linalg.svd(outer - centre, full_matrices=False)
    radius = float(np.linalg.norm(outer - centre, axis=1).mean())
    local = (points[np.concatenate(loops)] - centre) @ axes.T
    deviation = float(np.abs(local[:, 2]).max())
    limit = LARGEST_DEVIATION_FROM_PLANE * radius
    if deviation > limit:
        raise InputError(
            f"surfaces: the rings at the base leave their plane by {1e3 * deviation:.1f} mm; expected at most "
            f"{1e3 * limit:.1f} mm: cut the surfaces by one plane, or give one closed surface with labels"
        )
    return local[:, :2]
