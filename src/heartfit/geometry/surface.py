"""Triangulated surfaces: connectivity, closedness, volume, and triangles labelled by region."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from heartfit.core.arrays import Floats, Integers, Names
from heartfit.core.errors import InputError

FACES_OF_TET = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])
"""Local nodes of the faces of a positively oriented tetrahedron, normals outwards."""

SURFACES = ("lv_endo", "rv_endo", "epi", "base")


def boundary_faces(tets: Integers) -> Integers:
    """Return the triangles (k,3) of one tetrahedron only, normals out of positively oriented tets."""
    faces = tets[:, FACES_OF_TET].reshape(-1, 3)
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[np.sort(first[count == 1])]


def directed_edges(triangles: Integers) -> Integers:
    """Return the edges (3k,2) of the triangles in their sense of rotation; edge e belongs to triangle e % k."""
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def rim_edges(triangles: Integers) -> Integers:
    """Return the directed edges (e,2) of a surface's open rims, in the sense of rotation of their triangles."""
    edges = directed_edges(triangles)
    nodes = int(triangles.max(initial=-1)) + 1
    numbers, reverse = edges @ [nodes, 1], edges @ [1, nodes]
    return edges[~np.isin(numbers, reverse)]


def rim_loops(triangles: Integers) -> list[Integers]:
    """Return closed loops of nodes around the openings of a surface, in its sense of rotation.

    Raises InputError if a rim touches itself, so that no loop can be followed.
    """
    edges = rim_edges(triangles)
    following = dict(edges.tolist())
    if len(following) != len(edges) or set(following) != set(following.values()):
        raise InputError(
            f"rim of a surface: {len(edges)} edges leave {len(following)} nodes; expected one edge per node; "
            "the opening is pinched, so mesh with a shorter edge length"
        )
    loops = []
    while following:
        start, node = following.popitem()
        loop = [start]
        while node != start:
            loop.append(node)
            node = following.pop(node)
        loops.append(np.array(loop))
    return sorted(loops, key=lambda loop: int(loop.min()))


def euler_characteristic(triangles: Integers) -> int:
    """Return nodes - edges + triangles: 2 minus twice the number of holes that go through a closed surface."""
    edges = np.unique(np.sort(directed_edges(triangles), axis=1), axis=0)
    return len(np.unique(triangles)) - len(edges) + len(triangles)


def neighbours(triangles: Integers) -> Integers:
    """Return pairs (e,2) of triangles that share an edge."""
    edges = np.sort(directed_edges(triangles), axis=1)
    owner = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort(edges.T)
    same = (edges[order][1:] == edges[order][:-1]).all(axis=1)
    return np.column_stack([owner[order][:-1][same], owner[order][1:][same]])


def orient(triangles: Integers) -> Integers:
    """Return the same triangles with one sense of rotation in each connected part.

    A breadth-first walk over the triangles turns each of them to agree with its predecessor.
    """
    from scipy.sparse import coo_matrix  # only where meshes are made; it takes a tenth of a second
    from scipy.sparse.csgraph import breadth_first_order, connected_components

    pairs = neighbours(triangles)
    k = len(triangles)
    graph = coo_matrix((np.ones(len(pairs)), pairs.T), shape=(k, k)).tocsr()
    graph = graph + graph.T
    oriented = triangles.copy()
    _, component = connected_components(graph, directed=False)
    for root in np.unique(component, return_index=True)[1]:
        order, predecessor = breadth_first_order(graph, root, directed=False)
        for triangle in order[1:]:
            if not _agree(oriented[predecessor[triangle]], oriented[triangle]):
                oriented[triangle] = oriented[triangle][::-1]
    return oriented


def _agree(first: Integers, second: Integers) -> bool:
    """Return True if two triangles run through their common edge in opposite senses."""
    reverse = {(b, a) for a, b in _sides(first)}
    return any(side in reverse for side in _sides(second))


def _sides(triangle: Integers) -> list[tuple[int, int]]:
    a, b, c = triangle.tolist()
    return [(a, b), (b, c), (c, a)]


def enclosed_volume(points: Floats, triangles: Integers) -> float:
    """Volume [m^3] inside a closed surface, V = 1/6 sum a.(b x c), positive for outward normals."""
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

    points (n,3) [m]; triangles (k,3) int64; labels (k,), each one of SURFACES.
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
        """Triangles (k,3) by surface name."""
        return {name: self.triangles[self.labels == name] for name in SURFACES}

    def volume(self) -> float:
        """Wall volume [m^3]."""
        return enclosed_volume(self.points, self.triangles)

    def diagonal(self) -> float:
        """Length [m] of the diagonal of the bounding box."""
        return float(np.linalg.norm(np.ptp(self.points, axis=0)))


def require_closed(triangles: Integers) -> None:
    """Raise InputError unless the triangles run through every edge once in each sense."""
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
