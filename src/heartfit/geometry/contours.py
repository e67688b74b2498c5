"""Contours in a plane as segments in any order, as heartfit.geometry.cut makes them: area, distance, crossing rays."""

import numpy as np

from heartfit.geometry.arrays import Floats


def enclosed_area(segments: Floats, normal: Floats) -> Floats:
    """Area (...) in m^2 inside closed contours of segments (...,s,2,3) m, 1/2 sum n.(a x b).

    normal (3,) is the unit normal of their plane; contours that run clockwise about it count as negative.
    """
    start, end = np.moveaxis(segments - segments[..., :1, :1, :], -2, 0)
    area: Floats = 0.5 * np.cross(start, end).sum(axis=-2) @ normal
    return area


def distance_to(points: Floats, segments: Floats) -> Floats:
    """Distance (n,) in m of points (n,3) from the nearest point of segments (s,2,3)."""
    start, along = segments[:, 0], segments[:, 1] - segments[:, 0]
    from_start = points[:, None] - start
    square = np.maximum((along**2).sum(axis=-1), np.finfo(float).tiny)
    share = np.clip((from_start * along).sum(axis=-1) / square, 0.0, 1.0)
    nearest: Floats = np.linalg.norm(from_start - share[..., None] * along, axis=-1).min(axis=1)
    return nearest


def contour_distances(first: Floats, second: Floats) -> tuple[Floats, Floats]:
    """Distances (s + t,) in m from each of two contours, segments (s,2,3) and (t,2,3), to the other, and weights.

    Taken at the middle of each segment; its weight is its share of its contour's length, halved, so that weighted
    means are means along both contours and fine segments count no more than coarse ones.
    """
    pairs = ((first, second), (second, first))
    distances = [distance_to(one.mean(axis=1), other) for one, other in pairs]
    lengths = [np.linalg.norm(one[:, 1] - one[:, 0], axis=1) for one in (first, second)]
    return np.concatenate(distances), np.concatenate([length / (2.0 * length.sum()) for length in lengths])


def weighted_quantile(values: Floats, weights: Floats, share: float) -> float:
    """The least value that at least this share of the weights, which sum to one, does not exceed."""
    order = np.argsort(values)
    reached = int(np.searchsorted(np.cumsum(weights[order]), share - 1e-12))
    return float(values[order][min(reached, len(values) - 1)])


def ray_crossings(segments: Floats, centre: Floats, directions: Floats) -> Floats:
    """Lengths (r,s) at which rays from centre (2,) along unit directions (r,2) cross segments (s,2,2), else inf."""
    start, along = segments[:, 0] - centre, segments[:, 1] - segments[:, 0]
    across = _cross(directions[:, None], along)
    with np.errstate(divide="ignore", invalid="ignore"):
        length, share = _cross(start, along) / across, _cross(start, directions[:, None]) / across
    return np.where((length > 0.0) & (share >= 0.0) & (share < 1.0), length, np.inf)


def _cross(a: Floats, b: Floats) -> Floats:
    product: Floats = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return product
