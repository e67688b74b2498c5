"""Which voxels lie in a tetrahedron of the wall, and which inside a closed surface.

All coordinates are voxel indices. A slice k may be displaced in its plane, as by another breath-hold: its sample
(i, j) then lies at (i + shift[k, 0], j + shift[k, 1]).
"""

import numpy as np
from numba import njit

from heartfit.geometry.arrays import Floats, Integers

TOUCH = 1e-9
"""How negative a barycentric coordinate may be: a voxel on a face must not fall between two tetrahedra by round-off."""


@njit(cache=True)
def paint_wall(
    image: Floats, points: Floats, tets: Integers, material: Floats, texture: Floats, shift: Floats
) -> None:
    """Writes the texture of the tissue into the voxels (k,j,i) of ``image`` whose centres lie in a tetrahedron.

    points (n,3): where the nodes are; material (n,3): their indices in the array ``texture`` (k,j,i), which they keep
    through the beat.
    """
    depth, height, width = image.shape
    slope, carried = np.empty((4, 3)), np.empty((3, 3))
    for t in range(len(tets)):
        corner, seed = points[tets[t]], material[tets[t]]
        if not _slopes(corner, slope):
            continue
        _carry(seed, slope, carried)
        low, high = _range(corner[:, 2], 0.0, depth)
        for k in range(low, high):
            top, bottom = _range(corner[:, 1], shift[k, 1], height)
            z, start = k - corner[0, 2], corner[0, 0] - shift[k, 0]
            for j in range(top, bottom):
                y = j + shift[k, 1] - corner[0, 1]
                left, right = _row(slope, y, z)
                first, last = int(np.ceil(max(start + left, 0.0))), min(start + right, width - 1.0)
                for i in range(first, int(np.floor(last)) + 1):
                    x = i - start
                    image[k, j, i] = interpolated(
                        texture,
                        seed[0, 0] + carried[0, 0] * x + carried[0, 1] * y + carried[0, 2] * z,
                        seed[0, 1] + carried[1, 0] * x + carried[1, 1] * y + carried[1, 2] * z,
                        seed[0, 2] + carried[2, 0] * x + carried[2, 1] * y + carried[2, 2] * z,
                    )


@njit(cache=True)
def _slopes(corner: Floats, slope: Floats) -> bool:
    """Writes the gradients (4,3) of a tetrahedron's barycentric coordinates; false if it is flat."""
    six_volumes = 0.0
    for axis in range(3):
        p, q = (axis + 1) % 3, (axis + 2) % 3
        for n in range(3):
            b, c = 1 + (n + 1) % 3, 1 + (n + 2) % 3
            slope[1 + n, axis] = (corner[b, p] - corner[0, p]) * (corner[c, q] - corner[0, q])
            slope[1 + n, axis] -= (corner[b, q] - corner[0, q]) * (corner[c, p] - corner[0, p])
        six_volumes += (corner[1, axis] - corner[0, axis]) * slope[1, axis]
    if six_volumes == 0.0:
        return False
    for axis in range(3):
        for n in range(1, 4):
            slope[n, axis] /= six_volumes
        slope[0, axis] = -slope[1, axis] - slope[2, axis] - slope[3, axis]
    return True


@njit(cache=True)
def _carry(seed: Floats, slope: Floats, carried: Floats) -> None:
    """Writes the gradient (3,3) of what is seed (4,3) at a tetrahedron's corners and linear between them."""
    for a in range(3):
        for b in range(3):
            carried[a, b] = 0.0
            for n in range(4):
                carried[a, b] += seed[n, a] * slope[n, b]


@njit(cache=True)
def _row(slope: Floats, y: float, z: float) -> tuple[float, float]:
    """From which x to which a row lies in a tetrahedron; x, y, z are counted from its first corner."""
    left, right = -np.inf, np.inf
    for n in range(4):
        inside = slope[n, 1] * y + slope[n, 2] * z + TOUCH
        if n == 0:
            inside += 1.0
        if slope[n, 0] > 0.0:
            left = max(left, -inside / slope[n, 0])
        elif slope[n, 0] < 0.0:
            right = min(right, -inside / slope[n, 0])
        elif inside < 0.0:
            return 0.0, -1.0
    return left, right


@njit(cache=True)
def paint_inside(
    image: Floats, corners: Floats, triangles: Integers, brightness: float, shift: Floats
) -> None:
    """Writes a brightness into the voxels (k,j,i) about which the closed surface winds; corners (n,3).

    Along each row of voxels every crossing of the surface adds one or takes one away, by the side it is crossed from.
    """
    depth, height, width = image.shape
    bottom, top = _range(corners[:, 2], 0.0, depth)
    winding = np.zeros((max(top - bottom, 0), height, width + 1), np.int16)
    for t in range(len(triangles)):
        corner = corners[triangles[t]]
        low, high = _range(corner[:, 2], 0.0, depth)
        for k in range(low, high):
            front, back = _range(corner[:, 1], shift[k, 1], height)
            for j in range(front, back):
                x, turn = _crossing(corner, j + shift[k, 1], k)
                if turn != 0:
                    first = min(max(int(np.ceil(x - shift[k, 0])), 0), width)
                    winding[k - bottom, j, first] += turn
    for k in range(bottom, top):
        for j in range(height):
            turns = 0
            for i in range(width):
                turns += winding[k - bottom, j, i]
                if turns != 0:
                    image[k, j, i] = brightness


@njit(cache=True)
def _crossing(corner: Floats, y: float, z: float) -> tuple[float, int]:
    """Where the row (y, z) crosses a triangle, and from which side: 1 or -1, or 0 if it does not."""
    a, b, c = corner[0], corner[1], corner[2]
    left = _is_left(a[1], a[2], b[1], b[2], y, z)
    if _is_left(b[1], b[2], c[1], c[2], y, z) != left or _is_left(c[1], c[2], a[1], a[2], y, z) != left:
        return 0.0, 0
    area = (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1])
    if area == 0.0:
        return 0.0, 0
    u = ((y - a[1]) * (c[2] - a[2]) - (z - a[2]) * (c[1] - a[1])) / area
    v = ((b[1] - a[1]) * (z - a[2]) - (b[2] - a[2]) * (y - a[1])) / area
    return a[0] + u * (b[0] - a[0]) + v * (c[0] - a[0]), 1 if left else -1


@njit(cache=True)
def _is_left(ay: float, az: float, by: float, bz: float, y: float, z: float) -> bool:
    """Whether a row (y, z) passes to the left of the edge from a to b.

    For the edge from b to a the answer is the opposite, round-off or not, so that a row through an edge or a corner
    crosses just one of the triangles on either side.
    """
    if ay < by or (ay == by and az < bz):
        return (by - ay) * (z - az) - (bz - az) * (y - ay) >= 0.0
    return (ay - by) * (z - bz) - (az - bz) * (y - by) < 0.0


@njit(cache=True)
def sampled(fields: Floats, index: Floats, weight: Floats) -> Floats:
    """Fields (f,k,j,i) at fractional indices (3,...) in the order k, j, i where a weight is not 0, and 0 elsewhere.

    Linear between voxels, constant beyond the outermost, in the precision of the fields.
    """
    values = np.zeros((len(fields), *weight.shape), fields.dtype)
    for place in np.ndindex(weight.shape):
        if weight[place] != 0.0:
            k, j, i = index[0][place], index[1][place], index[2][place]
            for f in range(len(fields)):
                values[f][place] = interpolated(fields[f], i, j, k)
    return values


@njit(cache=True)
def interpolated(field: Floats, i: float, j: float, k: float) -> float:
    """The field (k,j,i) at fractional indices, linear between voxels, constant beyond the outermost."""
    k0, k1, w = _neighbours(k, field.shape[0])
    j0, j1, v = _neighbours(j, field.shape[1])
    i0, i1, u = _neighbours(i, field.shape[2])
    front = (1.0 - v) * ((1.0 - u) * field[k0, j0, i0] + u * field[k0, j0, i1])
    front += v * ((1.0 - u) * field[k0, j1, i0] + u * field[k0, j1, i1])
    back = (1.0 - v) * ((1.0 - u) * field[k1, j0, i0] + u * field[k1, j0, i1])
    back += v * ((1.0 - u) * field[k1, j1, i0] + u * field[k1, j1, i1])
    return (1.0 - w) * front + w * back


@njit(cache=True)
def _neighbours(place: float, count: int) -> tuple[int, int, float]:
    """The voxels on either side of a place, and how much of the way from the first to the second it lies."""
    held = min(max(place, 0.0), count - 1.0)
    first = min(int(held), max(count - 2, 0))
    return first, min(first + 1, count - 1), held - first


@njit(cache=True)
def _range(coordinates: Floats, shift: float, count: int) -> tuple[int, int]:
    """First and one past the last of ``count`` samples n + shift between the smallest and the largest coordinate."""
    low, high = coordinates.min() - shift, coordinates.max() - shift
    return max(int(np.ceil(low)), 0), min(int(np.floor(high)) + 1, count)
