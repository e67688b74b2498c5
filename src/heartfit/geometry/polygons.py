"""Flat convex polygons whose corners carry values, cut where something that varies linearly over them is zero."""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from heartfit.geometry.arrays import Floats, Integers

Polygon = Floats
"""Corners in turn (k, 3 + v): places in m and v values at them."""


def clipped(polygon: Polygon, height: Floats) -> Polygon:
    """The part where the height (k,) at the corners, linear in between, is not negative; empty if there is none."""
    following, above = np.roll(polygon, -1, axis=0), np.roll(height, -1)
    crossed = (height >= 0.0) != (above >= 0.0)
    share = np.divide(height, height - above, where=crossed, out=np.zeros_like(height))
    crossings = polygon + share[:, None] * (following - polygon)
    corners = np.stack([polygon, crossings], axis=1).reshape(-1, polygon.shape[1])
    return corners[np.stack([height >= 0.0, crossed], axis=1).ravel()]


def bands(polygon: Polygon, column: int, levels: Floats) -> Iterator[tuple[int, Polygon]]:
    """The parts between neighbouring ``levels`` of the value in a column, each with the index of its lower level."""
    lowest, highest = polygon[:, column].min(), polygon[:, column].max()
    for band, (low, high) in enumerate(pairwise(levels)):
        if lowest < high and highest >= low:
            part = clipped(polygon, polygon[:, column] - low)
            part = clipped(part, high - part[:, column])
            if len(part) > 2:
                yield band, part


def sections(corners: Floats, tets: Integers, height: Floats) -> Iterator[Polygon]:
    """Where tetrahedra (m,4) cross height zero; corners (n, 3 + v) and height (n,) at the nodes."""
    above = height[tets] >= 0.0
    for tet in tets[above.any(axis=1) & ~above.all(axis=1)]:
        yield _section(corners[tet], height[tet])


def _section(corners: Floats, height: Floats) -> Polygon:
    """The three or four crossings of edges from below to above, in turn: neighbours share a corner and so a face."""
    low, high = np.flatnonzero(height < 0.0), np.flatnonzero(height >= 0.0)
    pairs = [(i, j) for turn, i in enumerate(low) for j in (high if turn % 2 == 0 else high[::-1])]
    start, end = np.array(pairs).T
    share = height[start] / (height[start] - height[end])
    crossing: Polygon = corners[start] + share[:, None] * (corners[end] - corners[start])
    return crossing
