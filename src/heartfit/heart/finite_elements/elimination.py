"""Symbolic analysis of the multifrontal factorisation: fronts of nodes that are eliminated together.

METIS orders the nodes by nested dissection. The elimination of a node connects its later neighbours, so the rows that
it touches are its own neighbours and those passed on by its children in the elimination tree. Runs of nodes with nearly
the same rows are eliminated at once, as a *front*: a dense matrix of its own nodes and of the rows it touches.
Sources: Duff and Reid, ACM Trans. Math. Softw. 9 (1983) 302; Ashcraft and Grimes, ibid. 15 (1989) 291, for merging.
"""

from dataclasses import dataclass

import numpy as np
import pymetis
from numba import njit

from heartfit.core.arrays import Integers

MERGE_SIZE, MERGE_WASTE, LARGEST_FRONT = 8, 0.05, 32
"""A front is merged into its parent if both have at most MERGE_SIZE nodes, or at most LARGEST_FRONT and at most the
fraction MERGE_WASTE of their entries becomes explicit zeros."""


@dataclass(frozen=True, eq=False)
class Fronts:
    """Fronts of a mesh, in the order of their elimination; positions of nodes count in that order.

    ``order`` (n,) are the nodes by position. Front s eliminates the positions ``starts[s]`` to ``starts[s + 1]`` and
    touches the positions ``rows[row_starts[s] : row_starts[s + 1]]``, which ascend; ``parents`` (k,) is the front that
    eliminates the first of them, -1 for none.
    """

    order: Integers
    starts: Integers
    rows: Integers
    row_starts: Integers
    parents: Integers


def find_fronts(tets: Integers, nodes: int) -> Fronts:
    """Fronts of a mesh of tetrahedra (m, 4) with the given number of nodes."""
    pairs = _neighbours(tets, nodes)
    order = _nested_dissection(pairs, nodes)
    later, earlier = _ordered(pairs, order)
    order = order[_postorder(_elimination_tree(*_lists(later, earlier, nodes)))]
    later, earlier = _ordered(pairs, order)
    below = _lists(later, earlier, nodes)
    parents = _elimination_tree(*below)
    counts = _row_counts(*below, parents)
    starts = _merge_supernodes(
        _supernodes(parents, counts, LARGEST_FRONT), parents, counts, MERGE_SIZE, MERGE_WASTE, LARGEST_FRONT
    )
    rows, row_starts, above = _front_rows(starts, *_lists(earlier, later, nodes), counts)
    return Fronts(order, starts, rows, row_starts, above)


def _neighbours(tets: Integers, nodes: int) -> Integers:
    """Ordered pairs (2, k) of different nodes that share a tetrahedron."""
    keys = np.unique(nodes * np.repeat(tets, 4, axis=1).ravel() + np.tile(tets, (1, 4)).ravel())
    first, second = np.divmod(keys, nodes)
    return np.stack([first, second])[:, first != second]


def _nested_dissection(pairs: Integers, nodes: int) -> Integers:
    starts, adjacent = _lists(pairs[0], pairs[1], nodes)
    adjacency = pymetis.CSRAdjacency(adj_starts=starts, adjacent=adjacent)
    order, _ = pymetis.nested_dissection(adjacency)
    return np.asarray(order, dtype=np.int64)


def _ordered(pairs: Integers, order: Integers) -> Integers:
    """Positions (2, k / 2) in the ``order`` of the nodes of every pair, the later one first."""
    position = np.empty_like(order)
    position[order] = np.arange(len(order))
    placed = position[pairs]
    result: Integers = placed[:, placed[0] > placed[1]]
    return result


def _lists(first: Integers, second: Integers, nodes: int) -> tuple[Integers, Integers]:
    """Starts (n + 1,) of the lists of all second nodes of the first ones, and the lists, which ascend."""
    keys = np.sort(nodes * first + second)
    return np.searchsorted(keys, nodes * np.arange(nodes + 1)), keys % nodes


@njit(cache=True)
def _elimination_tree(starts: Integers, below: Integers) -> Integers:
    """Parents (n,) in the elimination tree, -1 at a root; ``below`` lists the earlier neighbours of every node."""
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
    """Order (n,) of the nodes in which every subtree is contiguous, its root last."""
    n = len(parents)
    child, sibling = np.full(n + 1, -1), np.full(n, -1)
    for j in range(n - 1, -1, -1):
        sibling[j], child[parents[j]] = child[parents[j]], j
    order, path, count, depth = np.empty(n, dtype=np.int64), np.empty(n + 1, dtype=np.int64), 0, 0
    path[0] = -1
    while depth >= 0:
        j = path[depth]
        following = child[j]
        if following == -1:
            depth -= 1
            if j >= 0:
                order[count] = j
                count += 1
        else:
            child[j] = sibling[following]
            depth += 1
            path[depth] = following
    return order


@njit(cache=True)
def _row_counts(starts: Integers, below: Integers, parents: Integers) -> Integers:
    """Numbers (n,) of later nodes that the eliminations touch, counted along the row subtrees."""
    n = len(parents)
    counts, marks = np.zeros(n, dtype=np.int64), np.full(n, -1)
    for i in range(n):
        marks[i] = i
        for k in range(starts[i], starts[i + 1]):
            j = below[k]
            while marks[j] != i:
                counts[j] += 1
                marks[j] = i
                j = parents[j]
    return counts


@njit(cache=True)
def _supernodes(parents: Integers, counts: Integers, largest: int) -> Integers:
    """Starts of the supernodes, the runs of nodes that touch the same rows."""
    n = len(parents)
    starts = [0]
    for j in range(1, n):
        if parents[j - 1] != j or counts[j - 1] != counts[j] + 1 or j - starts[-1] == largest:
            starts.append(j)
    starts.append(n)
    return np.array(starts)


@njit(cache=True)
def _merge_supernodes(
    starts: Integers, parents: Integers, counts: Integers, small: int, waste: float, largest: int
) -> Integers:
    """Starts of the fronts: supernodes merged into the next one where few entries become explicit zeros."""
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
def _front_rows(
    starts: Integers, above_starts: Integers, above: Integers, counts: Integers
) -> tuple[Integers, Integers, Integers]:
    """Rows touched by the fronts, their starts, and the parents of the fronts."""
    n, k = len(counts), len(starts) - 1
    home = np.empty(n, dtype=np.int64)
    for s in range(k):
        home[starts[s] : starts[s + 1]] = s
    rows, row_starts, parents = np.empty(16 * n, dtype=np.int64), np.zeros(k + 1, np.int64), np.full(k, -1)
    marks = np.full(n, -1)
    head, following = np.full(k, -1), np.full(k, -1)
    for s in range(k):
        end, filled = starts[s + 1], row_starts[s]
        room = n - end
        if filled + room > len(rows):
            rows = np.concatenate((rows, np.empty(max(len(rows), room), dtype=np.int64)))
        for j in range(starts[s], end):
            filled = _append_rows(rows, filled, above[above_starts[j] : above_starts[j + 1]], end, marks, s)
        child = head[s]
        while child != -1:
            filled = _append_rows(
                rows, filled, rows[row_starts[child] : row_starts[child + 1]], end, marks, s
            )
            child = following[child]
        rows[row_starts[s] : filled].sort()
        row_starts[s + 1] = filled
        if filled > row_starts[s]:
            parents[s] = home[rows[row_starts[s]]]
            following[s], head[parents[s]] = head[parents[s]], s
    return rows[: row_starts[k]].copy(), row_starts, parents


@njit(cache=True)
def _append_rows(rows: Integers, filled: int, new: Integers, end: int, marks: Integers, s: int) -> int:
    """Append the ``new`` rows of front s that it neither has nor eliminates; return the number of rows filled."""
    for i in new:
        if i >= end and marks[i] != s:
            marks[i] = s
            rows[filled] = i
            filled += 1
    return filled
