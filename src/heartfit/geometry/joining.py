"""Joins both endocardia and the epicardium, open at the base, to the closed surface of the wall.

Two kinds of epicardium are taken. One reaches the valve rings: its openings are those of the endocardia, node for node,
and its triangles at these rings are the base. Or it has one opening around both endocardia's, each with one of its
own: the base is the plane part between the three rings, by Mapbox's earcut.
"""

from collections.abc import Mapping

import numpy as np
from scipy.spatial import cKDTree

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats, Integers, Names
from heartfit.geometry.surface import LabelledSurface, enclosed_volume
from heartfit.geometry.topology import orient, rim_loops

OPEN = ("lv_endo", "rv_endo", "epi")
SAME, ONE = 1e-6, 1e-8
"""How near, m, nodes of two rings are at one place, and nodes of one surface."""

FLATTEST = 0.25
"""How far the rings of a base may leave their common plane, over the radius of the outer one."""


def joined(points: Floats, triangles: Mapping[str, Integers]) -> LabelledSurface:
    """The closed surface of triangles (k,3) of lv_endo, rv_endo and epi between the points (n,3) m, which it keeps.

    Raises InputError where rings neither coincide nor lie around each other in a plane.
    """
    parts = {name: orient(_sewn(points, triangles[name])) for name in OPEN}
    rings = {name: rim_loops(parts[name]) for name in OPEN}
    for name in OPEN:
        if not rings[name]:
            raise InputError(f"surface {name} has no opening; expected one at the base: leave the valves out")
    inner, outer = np.concatenate([*rings["lv_endo"], *rings["rv_endo"]]), np.concatenate(rings["epi"])
    distance, nearest = cKDTree(points[inner]).query(points[outer])
    if (distance < SAME).all():
        parts["epi"] = _replaced(parts["epi"], outer, inner[nearest])
        faces, labels = _stacked(parts)
        labels[(labels == "epi") & np.isin(faces, inner).any(axis=1)] = "base"
        return closed(points, faces, labels)
    faces, labels = _stacked(parts | {"base": _lid(points, rings)})
    return closed(points, faces, labels)


def closed(points: Floats, triangles: Integers, labels: Names) -> LabelledSurface:
    """The labelled surface with its triangles turned outwards; raises InputError if it is not closed."""
    faces = orient(triangles)
    return LabelledSurface(points, faces if enclosed_volume(points, faces) > 0.0 else faces[:, ::-1], labels)


def _sewn(points: Floats, triangles: Integers) -> Integers:
    """The triangles (k,3) where nodes at one place, as along the seams of patches, are the first of them."""
    nodes = np.unique(triangles)
    first = np.arange(len(points))
    for a, b in sorted(cKDTree(points[nodes]).query_pairs(ONE)):
        first[nodes[b]] = first[nodes[a]]
    return first[triangles]


def _replaced(triangles: Integers, nodes: Integers, others: Integers) -> Integers:
    """The triangles (k,3) with each of the nodes (n,) replaced by the other one (n,) at its place."""
    new = np.arange(int(triangles.max()) + 1)
    new[nodes] = others
    return new[triangles]


def _stacked(parts: Mapping[str, Integers]) -> tuple[Integers, Names]:
    labels = np.repeat(list(parts), [len(part) for part in parts.values()])
    return np.vstack(list(parts.values())), labels.astype("<U8")


def _lid(points: Floats, rings: Mapping[str, list[Integers]]) -> Integers:
    """Triangles between one ring of the epicardium and one of each endocardium inside it."""
    from mapbox_earcut import triangulate_float64

    counts = {name: len(rings[name]) for name in OPEN}
    if set(counts.values()) != {1}:
        said = ", ".join(f"{name} {count}" for name, count in counts.items())
        raise InputError(
            f"surfaces: openings {said}; expected one of each around the base, or an epicardium that reaches the "
            "valve rings node for node: cut the surfaces by one plane, or give one closed surface with labels"
        )
    loops = [rings[name][0] for name in ("epi", "lv_endo", "rv_endo")]
    flat = _in_plane(points, loops)
    ends = np.cumsum([len(loop) for loop in loops]).astype(np.uint32)
    found: Integers = np.concatenate(loops)[triangulate_float64(flat, ends)].reshape(-1, 3)
    return found


def _in_plane(points: Floats, loops: list[Integers]) -> Floats:
    """Coordinates (r,2) of the rings' nodes in the plane of the outer one; raises InputError if it is none."""
    outer = points[loops[0]]
    centre = outer.mean(axis=0)
    _, _, axes = np.linalg.svd(outer - centre, full_matrices=False)
    radius = float(np.linalg.norm(outer - centre, axis=1).mean())
    local = (points[np.concatenate(loops)] - centre) @ axes.T
    off = float(np.abs(local[:, 2]).max())
    if off > FLATTEST * radius:
        raise InputError(
            f"surfaces: the rings at the base leave their plane by {1e3 * off:.1f} mm; expected at most "
            f"{1e3 * FLATTEST * radius:.1f} mm: cut the surfaces by one plane, or give one closed surface with labels"
        )
    return local[:, :2]
