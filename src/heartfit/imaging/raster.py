"""Voxels in the tetrahedra of the wall and inside closed surfaces, and interpolation between voxels.

All coordinates are voxel indices. A slice k may be displaced in its plane, as by another breath-hold: its sample
(i, j) then lies at (i + shift[k, 0], j + shift[k, 1]).
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.mesh import VentricularMesh
from heartfit.imaging.sequence import Grid

FACE_TOLERANCE = 1e-9
"""Tolerance of barycentric coordinates: a voxel on a face must not fall between two tetrahedra by round-off."""


@njit(cache=True)
def paint_wall(
    image: Floats, points: Floats, tets: Integers, material: Floats, texture: Floats, shift: Floats
) -> None:
    """Write the texture of the tissue into the voxels (k, j, i) of ``image`` whose centres lie in a tetrahedron.

    points (n, 3): positions of the nodes; material (n, 3): their indices in the array ``texture`` (k, j, i), which are
    constant through the beat.
    """
    depth, height, width = image.shape
    slope, carried = np.empty((4, 3)), np.empty((3, 3))
    for t in range(len(tets)):
        corner, seed = points[tets[t]], material[tets[t]]
        if not _barycentric_gradients(corner, slope):
            continue
        _gradient(seed, slope, carried)
        low, high = _sample_range(corner[:, 2], 0.0, depth)
        for k in range(low, high):
            top, bottom = _sample_range(corner[:, 1], shift[k, 1], height)
            z, start = k - corner[0, 2], corner[0, 0] - shift[k, 0]
            for j in range(top, bottom):
                y = j + shift[k, 1] - corner[0, 1]
                left, right = _row_span(slope, y, z)
                first, last = int(np.ceil(max(start + left, 0.0))), min(start + right, width - 1.0)
                for i in range(first, int(np.floor(last)) + 1):
                    x = i - start
                    image[k, j, i] = interpolate(
                        texture,
                        seed[0, 0] + carried[0, 0] * x + carried[0, 1] * y + carried[0, 2] * z,
                        seed[0, 1] + carried[1, 0] * x + carried[1, 1] * y + carried[1, 2] * z,
                        seed[0, 2] + carried[2, 0] * x + carried[2, 1] * y + carried[2, 2] * z,
                    )


@njit(cache=True)
def _barycentric_gradients(corner: Floats, slope: Floats) -> bool:
    """Write the gradients (4, 3) of the barycentric coordinates of a tetrahedron; return false if it is flat."""
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
def _gradient(seed: Floats, slope: Floats, carried: Floats) -> None:
    """Write the gradient (3, 3) of the linear function with the values ``seed`` (4, 3) at the corners."""
    for a in range(3):
        for b in range(3):
            carried[a, b] = 0.0
            for n in range(4):
                carried[a, b] += seed[n, a] * slope[n, b]


@njit(cache=True)
def _row_span(slope: Floats, y: float, z: float) -> tuple[float, float]:
    """Interval of x in which the row (y, z) lies in a tetrahedron; x, y, z are relative to its first corner."""
    left, right = -np.inf, np.inf
    for n in range(4):
        inside = slope[n, 1] * y + slope[n, 2] * z + FACE_TOLERANCE
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
    """Write a brightness into the voxels (k, j, i) about which the closed surface winds; corners (n, 3).

    Along each row of voxels every crossing of the surface changes the winding number by 1 or -1, by its side.
    """
    depth, height, width = image.shape
    bottom, top = _sample_range(corners[:, 2], 0.0, depth)
    winding = np.zeros((max(top - bottom, 0), height, width + 1), np.int16)
    for t in range(len(triangles)):
        corner = corners[triangles[t]]
        low, high = _sample_range(corner[:, 2], 0.0, depth)
        for k in range(low, high):
            front, back = _sample_range(corner[:, 1], shift[k, 1], height)
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
    """Return x at which the row (y, z) crosses a triangle, and the side: 1 or -1, or 0 without a crossing."""
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
    """True if a row (y, z) passes to the left of the edge from a to b.

    For the edge from b to a the result is the opposite despite round-off, so a row through an edge or a corner
    crosses just one of the adjacent triangles.
    """
    if ay < by or (ay == by and az < bz):
        return (by - ay) * (z - az) - (bz - az) * (y - ay) >= 0.0
    return (ay - by) * (z - bz) - (az - bz) * (y - by) < 0.0


@njit(cache=True)
def sample_fields(fields: Floats, index: Floats, weight: Floats) -> Floats:
    """Values of fields (f, k, j, i) at fractional indices (3, ...) in the order k, j, i; 0 where the weight is 0.

    Linear between voxels, constant beyond the outermost, in the precision of the fields.
    """
    values = np.zeros((len(fields), *weight.shape), fields.dtype)
    for place in np.ndindex(weight.shape):
        if weight[place] != 0.0:
            k, j, i = index[0][place], index[1][place], index[2][place]
            for f in range(len(fields)):
                values[f][place] = interpolate(fields[f], i, j, k)
    return values


@njit(cache=True)
def interpolate(field: Floats, i: float, j: float, k: float) -> float:
    """Value of a field (k, j, i) at fractional indices, linear between voxels, constant beyond the outermost."""
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
    """Voxels on either side of a position, and its relative distance from the first towards the second."""
    clipped = min(max(place, 0.0), count - 1.0)
    first = min(int(clipped), max(count - 2, 0))
    return first, min(first + 1, count - 1), clipped - first


@njit(cache=True)
def _sample_range(coordinates: Floats, shift: float, count: int) -> tuple[int, int]:
    """First and one past the last of ``count`` samples n + shift between the smallest and the largest coordinate."""
    low, high = coordinates.min() - shift, coordinates.max() - shift
    return max(int(np.ceil(low)), 0), min(int(np.floor(high)) + 1, count)


def wall_voxels(grid: Grid, mesh: VentricularMesh) -> NDArray[np.bool_]:
    """Mask (k, j, i) of the voxels whose centres lie in a tetrahedron of the mesh."""
    places = grid.index(mesh.points)
    painted = np.zeros(grid.shape)
    paint_wall(painted, places, mesh.tets, places, np.ones((1, 1, 1)), np.zeros((grid.size[2], 2)))
    return painted > 0.0
