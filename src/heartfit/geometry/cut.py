"""Where a plane cuts a triangulated surface."""

import numpy as np

from heartfit.geometry.arrays import Floats, Integers


def cut(points: Floats, triangles: Integers, origin: Floats, normal: Floats) -> Floats:
    """Segments (s,2,3) in m along which the plane through origin (3,) with this normal (3,) cuts the triangles.

    points (n,3) m; triangles (k,3). Each segment runs from start to end so that what the triangles' normals point
    away from lies on its left, seen from where the plane's normal points to: a closed surface with outward normals
    is cut into closed counterclockwise contours of area 1/2 sum n.(a x b). Neighbouring segments share their ends
    to the bit. A node in the plane counts as above it, so no contour breaks there.
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
    place: Floats = points[lower] + share[:, None] * (points[upper] - points[lower])
    return place
