r"""Which nodes of a mesh are eliminated together, and what each elimination leaves to later ones.

METIS orders the nodes by nested dissection. Eliminating a node joins its later neighbours, so the rows that it
touches are its own neighbours and what its children in the elimination tree left. Runs of nodes with nearly the same
rows are eliminated at once, as a *front*: dense matrices of its own nodes and of the rows it touches.
Source: Duff and Reid, ACM Trans. Math. Softw. 9 (1983) 302; Ashcraft and Grimes, ibid. 15 (1989) 291, for merging.
"""

from dataclasses import dataclass

import numpy as np
import pymetis
from numba import njit
from scipy.sparse import coo_array, csr_array, tril

from heartfit.geometry.arrays import Integers

SMALL, WASTE, LARGEST = 8, 0.05, 32
"""A front is merged into its parent if both together have few nodes, or if few entries become needless zeros."""


@dataclass(frozen=True, eq=False)
class Fronts:
    """Fronts of a mesh, in the order of their elimination; nodes are counted in that order.

    ``order`` (n,) is the node at each position. Front s eliminates the positions ``starts[s]`` to
    ``starts[s + 1]`` and touches the positions ``rows[row_starts[s] : row_starts[s + 1]]``, which ascend; ``parents``
    (k,) is the front that eliminates the first of them, -1 for none.
    """

    order: Integers
    starts: Integers
    rows: Integers
    row_starts: Integers
    parents: Integers


def fronts(tets: Integers, nodes: int) -> Fronts:
    """The fronts of a mesh of tetrahedra (m, 4)."""
    graph = _graph(tets, nodes)
    order = _nested_dissection(graph)
    lower = csr_array(tril(graph[order][:, order], k=-1))
    order = order[_postorder(_tree(lower.indptr, lower.indices))]
    lower = csr_array(tril(graph[order][:, order], k=-1))
    parents = _tree(lower.indptr, lower.indices)
    counts = _counts(lower.indptr, lower.indices, parents)
    starts = _merge(_runs(parents, counts, LARGEST), parents, counts, SMALL, WASTE, LARGEST)
    upper = csr_array(lower.T)
    rows, row_starts, above = _structure(starts, upper.indptr, upper.indices, counts)
    return Fronts(order, starts, rows, row_starts, above)


def _graph(tets: Integers, nodes: int) -> csr_array:
    first, second = np.repeat(tets, 4, axis=1).ravel(), np.tile(tets, (1, 4)).ravel()
    apart = first != second
    pairs = (first[apart], second[apart])
    return csr_array(coo_array((np.ones(apart.sum(), dtype=np.int32), pairs), shape=(nodes, nodes)).tocsr())


def _nested_dissection(graph: csr_array) -> Integers:
    adjacency = pymetis.CSRAdjacency(adj_starts=graph.indptr, adjacent=graph.indices)
    order, _ = pymetis.nested_dissection(adjacency)
    return np.asarray(order, dtype=np.int64)


@njit(cache=True)
def _tree(starts: Integers, below: Integers) -> Integers:
    """Elimination tree: the parent (n,) of every node, -1 at a root; ``below`` lists each node's earlier neighbours."""
    n = len(starts) - 1
    parents, ancestor = np.full(n, -1), np.full(n, -1)
    for i in range(n):
        for k in range(starts[i], starts[i + 1]):
            j = below[k]
            while j != -1 and j < i:
                following = ancestor[j]
                ancestor[j] = i
                if following == -1:
                    parents[j] = i
                j = following
    return parents


@njit(cache=True)
def _postorder(parents: Integers) -> Integers:
    """Nodes (n,) with every subtree in one run, its root last."""
    n = len(parents)
    child, sibling = np.full(n + 1, -1), np.full(n, -1)
    for j in range(n - 1, -1, -1):
        sibling[j], child[parents[j]] = child[parents[j]], j
    order, path, found, depth = np.empty(n, dtype=np.int64), np.empty(n + 1, dtype=np.int64), 0, 0
    path[0] = -1
    while depth >= 0:
        j = path[depth]
        following = child[j]
        if following == -1:
            depth -= 1
            if j >= 0:
                order[found] = j
                found += 1
        else:
            child[j] = sibling[following]
            depth += 1
            path[depth] = following
    return order


@njit(cache=True)
def _counts(starts: Integers, below: Integers, parents: Integers) -> Integers:
    """Number (n,) of later nodes that the elimination of each touches, by walking the row subtrees."""
    n = len(parents)
    counts, seen = np.zeros(n, dtype=np.int64), np.full(n, -1)
    for i in range(n):
        seen[i] = i
        for k in range(starts[i], starts[i + 1]):
            j = below[k]
            while seen[j] != i:
                counts[j] += 1
                seen[j] = i
                j = parents[j]
    return counts


@njit(cache=True)
def _runs(parents: Integers, counts: Integers, largest: int) -> Integers:
    """Starts of the runs of nodes that touch the same rows."""
    n = len(parents)
    starts = [0]
    for j in range(1, n):
        if parents[j - 1] != j or counts[j - 1] != counts[j] + 1 or j - starts[-1] == largest:
            starts.append(j)
    starts.append(n)
    return np.array(starts)


@njit(cache=True)
def _merge(
    starts: Integers, parents: Integers, counts: Integers, small: int, waste: float, largest: int
) -> Integers:
    """Starts of the fronts: runs merged into the run right after them where little is wasted."""
    kept, k = [0], len(starts) - 1
    zeros = 0.0
    for s in range(k - 1):
        first, cut, end = kept[-1], starts[s + 1], starts[s + 2]
        own, following = float(cut - first), float(end - cut)
        touched = counts[end - 1] + following
        needless = zeros + own * (touched - counts[cut - 1])
        total = (own + following) * (own + following + counts[end - 1])
        child = parents[cut - 1] >= cut and parents[cut - 1] < end
        if child and (own + following <= small or (own + following <= largest and needless <= waste * total)):
            zeros = needless
        else:
            kept.append(cut)
            zeros = 0.0
    kept.append(starts[k])
    return np.array(kept)


@njit(cache=True)
def _structure(
    starts: Integers, above_starts: Integers, above: Integers, counts: Integers
) -> tuple[Integers, Integers, Integers]:
    """Rows, their starts and the parent of every front."""
    n, k = len(counts), len(starts) - 1
    home = np.empty(n, dtype=np.int64)
    for s in range(k):
        home[starts[s] : starts[s + 1]] = s
    rows, row_starts, parents = np.empty(16 * n, dtype=np.int64), np.zeros(k + 1, np.int64), np.full(k, -1)
    seen = np.full(n, -1)
    head, following = np.full(k, -1), np.full(k, -1)
    for s in range(k):
        end, filled = starts[s + 1], row_starts[s]
        room = n - end
        if filled + room > len(rows):
            rows = np.concatenate((rows, np.empty(max(len(rows), room), dtype=np.int64)))
        for j in range(starts[s], end):
            filled = _join(rows, filled, above[above_starts[j] : above_starts[j + 1]], end, seen, s)
        child = head[s]
        while child != -1:
            filled = _join(rows, filled, rows[row_starts[child] : row_starts[child + 1]], end, seen, s)
            child = following[child]
        rows[row_starts[s] : filled].sort()
        row_starts[s + 1] = filled
        if filled > row_starts[s]:
            parents[s] = home[rows[row_starts[s]]]
            following[s], head[parents[s]] = head[parents[s]], s
    return rows[: row_starts[k]].copy(), row_starts, parents


@njit(cache=True)
def _join(rows: Integers, filled: int, new: Integers, end: int, seen: Integers, s: int) -> int:
    """Append to ``rows`` what of ``new`` front s has not seen and does not eliminate; how many are filled then."""
    for i in new:
        if i >= end and seen[i] != s:
            seen[i] = s
            rows[filled] = i
            filled += 1
    return filled
