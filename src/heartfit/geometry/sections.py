"""Plane sections of surfaces: contours, their areas and distances, and convex polygons."""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from heartfit.core.arrays import Floats, Integers

Polygon = Floats
"""Corners in turn (k, 3 + v): positions [m] and v values at them."""


def clip_polygon(polygon: Polygon, height: Floats) -> Polygon:
    """Return the part of non-negative height (k,), linear between the corners; empty if there is none."""
    following, above = np.roll(polygon, -1, axis=0), np.roll(height, -1)
    crossed = (height >= 0.0) != (above >= 0.0)
    share = np.divide(height, height - above, where=crossed, out=np.zeros_like(height))
    crossings = polygon + share[:, None] * (following - polygon)
    corners = np.stack([polygon, crossings], axis=1).reshape(-1, polygon.shape[1])
    return corners[np.stack([height >= 0.0, crossed], axis=1).ravel()]


def split_into_bands(polygon: Polygon, column: int, levels: Floats) -> Iterator[tuple[int, Polygon]]:
    """Yield the parts between neighbouring ``levels`` of the value in a column, with the index of the lower level."""
    lowest, highest = polygon[:, column].min(), polygon[:, column].max()
    for band, (low, high) in enumerate(pairwise(levels)):
        if lowest < high and highest >= low:
            part = clip_polygon(polygon, polygon[:, column] - low)
            part = clip_polygon(part, high - part[:, column])
            if len(part) > 2:
                yield band, part


def tetrahedra_sections(corners: Floats, tets: Integers, height: Floats) -> Iterator[Polygon]:
    """Yield the sections of tetrahedra (m,4) at height zero; corners (n, 3 + v) and height (n,) at the nodes."""
    above = height[tets] >= 0.0
    for tet in tets[above.any(axis=1) & ~above.all(axis=1)]:
        yield _section(corners[tet], height[tet])


def _section(corners: Floats, height: Floats) -> Polygon:
    """Return the three or four edge crossings in turn: neighbouring crossings lie on edges of one face."""
    low, high = np.flatnonzero(height < 0.0), np.flatnonzero(height >= 0.0)
    pairs = [(i, j) for turn, i in enumerate(low) for j in (high if turn % 2 == 0 else high[::-1])]
    start, end = np.array(pairs).T
    share = height[start] / (height[start] - height[end])
    crossing: Polygon = corners[start] + share[:, None] * (corners[end] - corners[start])
    return crossing


def cut_surface(points: Floats, triangles: Integers, origin: Floats, normal: Floats) -> Floats:
    """Return segments (s,2,3) [m] along which the plane through origin (3,) with this normal (3,) cuts the triangles.

    points (n,3) [m]; triangles (k,3). The side that the triangles' normals point away from lies on the left of each
    segment from start to end, seen against the plane's normal: a closed surface with outward normals is cut into
    closed counterclockwise contours of area 1/2 sum n.(a x b). Neighbouring segments share their ends to the bit. A
    node in the plane counts as above it, so no contour breaks there.
    """
    height = (points - origin) @ normal
    above = height[triangles] >= 0.0
    crossed = triangles[above.any(axis=1) & ~above.all(axis=1)]
    tail, head = crossed, np.roll(crossed, -1, axis=1)
    rising = (height[tail] < 0.0) & (height[head] >= 0.0)
    falling = (height[tail] >= 0.0) & (height[head] < 0.0)
    ends = [
        _crossing(points, height, lower=head[falling], upper=tail[falling]),
        _crossing(points, height, lower=tail[rising], upper=head[rising]),
    ]
    return np.stack(ends, axis=1)


def _crossing(points: Floats, height: Floats, lower: Integers, upper: Integers) -> Floats:
    share = height[lower] / (height[lower] - height[upper])
    crossing: Floats = points[lower] + share[:, None] * (points[upper] - points[lower])
    return crossing


def enclosed_area(segments: Floats, normal: Floats) -> Floats:
    """Area (...) [m^2] inside closed contours of segments (...,s,2,3) [m], 1/2 sum n.(a x b).

    normal (3,) is the unit normal of their plane; contours that run clockwise about it count as negative.
    """
    start, end = np.moveaxis(segments - segments[..., :1, :1, :], -2, 0)
    area: Floats = 0.5 * np.cross(start, end).sum(axis=-2) @ normal
    return area


def distance_to(points: Floats, segments: Floats) -> Floats:
    """Distance (n,) [m] of points (n,3) from the nearest point of segments (s,2,3)."""
    start, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    from_start = points[:, None] - start
    square = np.maximum((along**2).sum(axis=-1), np.finfo(float).tiny)
    share = np.clip((from_start * along).sum(axis=-1) / square, 0.0, 1.0)
    nearest: Floats = np.linalg.norm(from_start - share[..., None] * along, axis=-1).min(axis=1)
    return nearest


def contour_distances(first: Floats, second: Floats) -> tuple[Floats, Floats]:
    """Return distances (s + t,) [m] from each of two contours to the other, and weights (s + t,).

    first, second: segments (s,2,3) and (t,2,3) [m]. Distances are taken at the middle of each segment; its weight is
    half its share of its contour's length, so weighted means are means along both contours and fine segments count no
    more than coarse ones.
    """
    pairs = ((first, second), (second, first))
    distances = [distance_to(one.mean(axis=1), other) for one, other in pairs]
    lengths = [np.linalg.norm(one[:, 1] - one[:, 0], axis=1) for one in (first, second)]
    return np.concatenate(distances), np.concatenate([length / (2.0 * length.sum()) for length in lengths])


def weighted_quantile(values: Floats, weights: Floats, share: float) -> float:
    """Return the least value that at least this share of the weights, which sum to one, does not exceed."""
    order = np.argsort(values)
    index = int(np.searchsorted(np.cumsum(weights[order]), share - 1e-12))
    return float(values[order][min(index, len(values) - 1)])


def ray_crossings(segments: Floats, centre: Floats, directions: Floats) -> Floats:
    """Lengths (r,s) of rays from centre (2,) along unit directions (r,2) to segments (s,2,2); inf if they miss."""
    start, along = segments[:, 0] - centre, segments[:, 1] - segments[:, 0]
    across = _cross(directions[:, None], along)
    with np.errstate(divide="ignore", invalid="ignore"):
        length, share = _cross(start, along) / across, _cross(start, directions[:, None]) / across
    return np.where((length > 0.0) & (share >= 0.0) & (share < 1.0), length, np.inf)


def _cross(a: Floats, b: Floats) -> Floats:
    product: Floats = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product
