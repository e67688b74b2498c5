"""Which voxels lie in a tetrahedron of the wall, and which inside a closed surface.

All coordinates are voxel indices. A slice k may be displaced in its plane, as by another breath-hold: its sample
(i, j) then lies at (i + shift[k, 0], j + shift[k, 1]).
"""

import numpy as np
from numba import njit

from heartfit.geometry.arrays import Floats, Integers


@njit(cache=True)
def paint_wall(
    image: Floats, points: Floats, tets: Integers, material: Floats, texture: Floats, shift: Floats
) -> None:
    """Writes the texture of the tissue into the voxels (k,j,i) of ``image`` whose centres lie in a tetrahedron.

    points (n,3): where the nodes are; material (n,3): their indices in the array ``texture`` (k,j,i), which they keep
    through the beat.
    """
    depth, height, width = image.shape
    for t in range(len(tets)):
        corner, seed = points[tets[t]], material[tets[t]]
        edges = (corner[1:] - corner[0]).T.copy()
        if np.linalg.det(edges) == 0.0:
            continue
        inverse = np.linalg.inv(edges)
        carried = (seed[1:] - seed[0]).T @ inverse
        low, high = _range(corner[:, 2], 0.0, depth)
        for k in range(low, high):
            top, bottom = _range(corner[:, 1], shift[k, 1], height)
            left, right = _range(corner[:, 0], shift[k, 0], width)
            z = k - corner[0, 2]
            for j in range(top, bottom):
                y = j + shift[k, 1] - corner[0, 1]
                for i in range(left, right):
                    x = i + shift[k, 0] - corner[0, 0]
                    a = inverse[0, 0] * x + inverse[0, 1] * y + inverse[0, 2] * z
                    b = inverse[1, 0] * x + inverse[1, 1] * y + inverse[1, 2] * z
                    c = inverse[2, 0] * x + inverse[2, 1] * y + inverse[2, 2] * z
                    if a >= 0.0 and b >= 0.0 and c >= 0.0 and a + b + c <= 1.0:
                        image[k, j, i] = interpolated(
                            texture,
                            seed[0, 0] + carried[0, 0] * x + carried[0, 1] * y + carried[0, 2] * z,
                            seed[0, 1] + carried[1, 0] * x + carried[1, 1] * y + carried[1, 2] * z,
                            seed[0, 2] + carried[2, 0] * x + carried[2, 1] * y + carried[2, 2] * z,
                        )


@njit(cache=True)
def paint_inside(
    image: Floats, corners: Floats, triangles: Integers, brightness: float, shift: Floats
) -> None:
    """Writes a brightness into the voxels (k,j,i) about which the closed surface winds; corners (n,3).

    Along each row of voxels every crossing of the surface adds one or takes one away, by the side it is crossed from.
    """
    depth, height, width = image.shape
    winding = np.zeros((depth, height, width + 1), np.int16)
    for t in range(len(triangles)):
        a, b, c = corners[triangles[t, 0]], corners[triangles[t, 1]], corners[triangles[t, 2]]
        area = (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1])
        if area == 0.0:
            continue
        low, high = _range(np.array([a[2], b[2], c[2]]), 0.0, depth)
        for k in range(low, high):
            top, bottom = _range(np.array([a[1], b[1], c[1]]), shift[k, 1], height)
            for j in range(top, bottom):
                y = j + shift[k, 1]
                u = ((y - a[1]) * (c[2] - a[2]) - (k - a[2]) * (c[1] - a[1])) / area
                v = ((b[1] - a[1]) * (k - a[2]) - (b[2] - a[2]) * (y - a[1])) / area
                if u >= 0.0 and v >= 0.0 and u + v <= 1.0:
                    x = a[0] + u * (b[0] - a[0]) + v * (c[0] - a[0]) - shift[k, 0]
                    first = min(max(int(np.ceil(x)), 0), width)
                    winding[k, j, first] += 1 if area > 0.0 else -1
    for k in range(depth):
        for j in range(height):
            turns = 0
            for i in range(width):
                turns += winding[k, j, i]
                if turns != 0:
                    image[k, j, i] = brightness


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
