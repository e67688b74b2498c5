"""What follows from the connectivity of triangles and tetrahedra alone."""

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, connected_components

from heartfit.errors import InputError
from heartfit.geometry.arrays import Integers

FACES_OF_TET = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])


def boundary_faces(tets: Integers) -> Integers:
    """Triangles (k,3) of one tetrahedron only, normals pointing out of positively oriented tets."""
    faces = tets[:, FACES_OF_TET].reshape(-1, 3)
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[np.sort(first[count == 1])]


def directed_edges(triangles: Integers) -> Integers:
    """The edges (3k,2) of the triangles in their sense of rotation; edge e belongs to triangle e % k."""
    return np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])


def rim_edges(triangles: Integers) -> Integers:
    """Directed edges (e,2) of a surface's open rims, in the sense of rotation of their triangles."""
    edges = directed_edges(triangles)
    reverse = set(map(tuple, edges[:, ::-1].tolist()))
    return edges[[tuple(edge) not in reverse for edge in edges.tolist()]]


def rim_loops(triangles: Integers) -> list[Integers]:
    """Closed loops of nodes around the openings of a surface, in its sense of rotation.

    Raises InputError where a rim touches itself, so that no loop can be followed.
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
    """Nodes - edges + triangles: 2 minus twice the number of holes that go through a closed surface."""
    edges = np.unique(np.sort(directed_edges(triangles), axis=1), axis=0)
    return len(np.unique(triangles)) - len(edges) + len(triangles)


def neighbours(triangles: Integers) -> Integers:
    """Pairs (e,2) of triangles that share an edge."""
    edges = np.sort(directed_edges(triangles), axis=1)
    owner = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort(edges.T)
    same = (edges[order][1:] == edges[order][:-1]).all(axis=1)
    return np.column_stack([owner[order][:-1][same], owner[order][1:][same]])


def orient(triangles: Integers) -> Integers:
    """The same triangles, turned so that adjacent ones agree in their sense of rotation.

    Walks breadth-first over the triangles and turns each to agree with the one it was reached from.
    """
    pairs = neighbours(triangles)
    k = len(triangles)
    graph = coo_matrix((np.ones(len(pairs)), pairs.T), shape=(k, k)).tocsr()
    graph = graph + graph.T
    turned = triangles.copy()
    _, component = connected_components(graph, directed=False)
    for root in np.unique(component, return_index=True)[1]:
        order, came_from = breadth_first_order(graph, root, directed=False)
        for triangle in order[1:]:
            if not _agree(turned[came_from[triangle]], turned[triangle]):
                turned[triangle] = turned[triangle][::-1]
    return turned


def _agree(first: Integers, second: Integers) -> bool:
    """Two triangles agree where they run through their common edge in opposite senses."""
    reverse = {(b, a) for a, b in _sides(first)}
    return any(side in reverse for side in _sides(second))


def _sides(triangle: Integers) -> list[tuple[int, int]]:
    a, b, c = triangle.tolist()
    return [(a, b), (b, c), (c, a)]
