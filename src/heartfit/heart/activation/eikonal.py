"""Anisotropic eikonal equation on tetrahedra: arrival times of the wave of depolarisation.

Equations
---------
v sqrt(grad T . D grad T) = 1,  D = f f' + r^2 (I - f f'),  T prescribed at the sites.
With the slowness metric M = D^-1 / v^2, a path dx takes the time sqrt(dx' M dx). Within an element T is
linear; with the edges r_i from the known corners to the vertex, G_ij = r_i' M r_j and t the known times, the
arrival tau obeys

    (tau 1 - t)' G^-1 (tau 1 - t) = 1,   and the ray comes from inside where  G^-1 (tau 1 - t) >= 0;

otherwise the ray runs along a face or an edge, whose G is a block of the same matrix. Nodes are updated from a queue
until no arrival becomes earlier: T only decreases, and the result depends on the order of the nodes by no more than
`ARRIVAL_TOLERANCE`.

A thin layer of fast conduction, the Purkinje network under the endocardium, is a set of triangles with its own speed.

References
----------
Fu Z, Kirby RM, Whitaker RT 2013, doi 10.1137/120881956.
"""

from collections.abc import Mapping

import numpy as np
from numba import njit

from heartfit.core.arrays import Floats, Integers

ARRIVAL_TOLERANCE = 1e-9
"""Smallest decrease of an arrival time [s] that is passed on to the neighbours."""

NO_TRIANGLES = np.empty((0, 3), dtype=np.int64)


def activation_times(
    points: Floats,
    tets: Integers,
    fibres: Floats,
    sites: Mapping[int, float],
    speed: float = 0.6,
    ratio: float = 0.45,
    fast_layer: Integers = NO_TRIANGLES,
    fast_speed: Floats | float = 3.0,
) -> Floats:
    """Arrival times (n,) [s] of the wave that starts at the ``sites``, {node: time [s]}.

    ``fibres`` (m, 3) are unit vectors, ``speed`` [m/s] is that along the fibres and ``ratio`` that across them over it.
    The triangles ``fast_layer`` (k, 3) conduct at ``fast_speed`` [m/s], one or (k,), in every direction. A site that
    the wave reaches earlier takes that time. Raises ValueError without sites, for speeds or a ratio that are not
    positive, or if a node is connected to no site.
    """
    slowest = float(np.min(fast_speed, initial=np.inf))
    if not sites or min(speed, ratio, slowest) <= 0.0:
        raise ValueError(
            f"activation: {len(sites)} sites, speed {speed:g} m/s, ratio {ratio:g}, "
            f"fast speed {slowest:g} m/s; "
            "expected at least one site and positive numbers"
        )
    times = np.full(len(points), np.inf)
    times[list(sites)] = list(sites.values())
    start = np.array(sorted(sites), dtype=np.int64)
    metric = slowness_metric(fibres, speed, ratio)
    isotropic = np.eye(3) / np.broadcast_to(fast_speed, len(fast_layer))[:, None, None] ** 2
    _march(
        times,
        start,
        *_fans(points, tets, metric),
        *_fans(points, np.asarray(fast_layer, dtype=np.int64), isotropic),
    )
    if not np.isfinite(times).all():
        raise ValueError(
            f"activation: {int(np.isinf(times).sum())} nodes are connected to no site; expected none"
        )
    return times


def slowness_metric(fibres: Floats, speed: float, ratio: float) -> Floats:
    """Slowness metric M = D^-1 / v^2 (m, 3, 3) [s^2/m^2], with D^-1 = f f' + (I - f f') / r^2."""
    along = fibres[:, :, None] * fibres[:, None, :]
    return (along + (np.eye(3) - along) / ratio**2) / speed**2


def _fans(points: Floats, elements: Integers, metric: Floats) -> tuple[Integers, Integers, Floats]:
    """Elements around every node: their starts (n + 1,), their other corners (e, k) and their matrices G (e, k, k)."""
    corners = elements.shape[1]
    vertex = elements.T.reshape(-1)
    others = np.concatenate([np.delete(elements, i, axis=1) for i in range(corners)])
    order = np.argsort(vertex, kind="stable")
    edges = points[vertex][:, None] - points[others]
    gram = np.einsum("eia,eab,ejb->eij", edges, np.concatenate([metric] * corners), edges)
    start = np.searchsorted(vertex[order], np.arange(len(points) + 1))
    return start, others[order], np.ascontiguousarray(gram[order])


@njit(cache=True)
def _march(
    times: Floats,
    sites: Integers,
    tet_start: Integers,
    tet_others: Integers,
    tet_gram: Floats,
    fast_start: Integers,
    fast_others: Integers,
    fast_gram: Floats,
) -> None:
    """Lower the times in place until no node can be reached earlier; the queue is a ring buffer of all nodes."""
    n = len(times)
    queue, queued = np.empty(n, np.int64), np.zeros(n, np.int64)
    head = waiting = 0
    for site in sites:
        waiting = _push_around(site, tet_start, tet_others, queue, queued, head, waiting)
    while waiting > 0:
        node = queue[head]
        queued[node] = 0
        head, waiting = (head + 1) % n, waiting - 1
        arrival = times[node]
        for e in range(tet_start[node], tet_start[node + 1]):
            arrival = min(arrival, _through_tet(tet_gram[e], times, tet_others[e]))
        for e in range(fast_start[node], fast_start[node + 1]):
            arrival = min(arrival, _through_face(fast_gram[e], times, fast_others[e], 0, 1))
        if arrival < times[node] - ARRIVAL_TOLERANCE:
            times[node] = arrival
            waiting = _push_around(node, tet_start, tet_others, queue, queued, head, waiting)


@njit(cache=True)
def _push_around(
    node: int,
    start: Integers,
    others: Integers,
    queue: Integers,
    queued: Integers,
    head: int,
    waiting: int,
) -> int:
    for e in range(start[node], start[node + 1]):
        for neighbour in others[e]:
            if not queued[neighbour]:
                queue[(head + waiting) % len(queue)] = neighbour
                queued[neighbour] = 1
                waiting += 1
    return waiting


@njit(cache=True)
def _through_tet(gram: Floats, times: Floats, corners: Integers) -> float:
    """Earliest arrival through the other three corners of a tetrahedron, or through its faces and edges."""
    t0, t1, t2 = times[corners[0]], times[corners[1]], times[corners[2]]
    if np.isfinite(t0 + t1 + t2):
        arrival = _plane_wave(np.linalg.inv(gram), np.array([t0, t1, t2]))
        if np.isfinite(arrival):
            return arrival
    return min(
        _through_face(gram, times, corners, 0, 1),
        _through_face(gram, times, corners, 1, 2),
        _through_face(gram, times, corners, 0, 2),
    )


@njit(cache=True)
def _through_face(gram: Floats, times: Floats, corners: Integers, i: int, j: int) -> float:
    """Earliest arrival through the corners i and j, or along one edge."""
    t = np.array([times[corners[i]], times[corners[j]]])
    if np.isfinite(t[0] + t[1]):
        a, b, c = gram[i, i], gram[i, j], gram[j, j]
        determinant = a * c - b * b
        inverse = np.empty((2, 2))
        inverse[0, 0], inverse[0, 1] = c / determinant, -b / determinant
        inverse[1, 0], inverse[1, 1] = inverse[0, 1], a / determinant
        arrival = _plane_wave(inverse, t)
        if np.isfinite(arrival):
            return arrival
    return min(t[0] + np.sqrt(gram[i, i]), t[1] + np.sqrt(gram[j, j]))


@njit(cache=True)
def _plane_wave(inverse: np.ndarray, t: Floats) -> float:
    """Later root tau of (tau 1 - t)' G^-1 (tau 1 - t) = 1; infinite where the ray comes from outside the element."""
    n = len(t)
    a = b = c = 0.0
    for i in range(n):
        row, weighted = 0.0, 0.0
        for j in range(n):
            row += inverse[i, j]
            weighted += inverse[i, j] * t[j]
        a, b, c = a + row, b + row * t[i], c + t[i] * weighted
    discriminant = b * b - a * (c - 1.0)
    if discriminant < 0.0:
        return np.inf
    arrival = (b + np.sqrt(discriminant)) / a
    for i in range(n):
        inwards = 0.0
        for j in range(n):
            inwards += inverse[i, j] * (arrival - t[j])
        if inwards < 0.0:
            return np.inf
    return arrival
