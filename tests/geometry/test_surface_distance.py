"""Closed forms: parallel planes, a gliding plane, spheres about one centre."""

import numpy as np
import pytest

from heartfit.core.arrays import Floats, Integers
from heartfit.geometry.carry import surface_distances

SIDE = 9


def sheet(height: float, middle: float = 0.5) -> tuple[Floats, Integers]:
    """A square of side 1 at a height, whose middle column of nodes lies at x = middle."""
    x = np.interp(np.arange(SIDE), [0, SIDE // 2, SIDE - 1], [0.0, middle, 1.0])
    points = np.array([(a, b, height) for a in x for b in np.linspace(0.0, 1.0, SIDE)])
    corner = (np.arange(SIDE - 1)[:, None] * SIDE + np.arange(SIDE - 1)).ravel()
    lower = np.column_stack([corner, corner + SIDE, corner + 1])
    return points, np.vstack([lower, np.column_stack([corner + 1, corner + SIDE, corner + SIDE + 1])])


def test_parallel_sheets_have_their_distance_everywhere() -> None:
    points, triangles = sheet(0.0)
    distances, weights = surface_distances(points, sheet(0.3)[0], triangles)
    assert distances == pytest.approx(np.full(2 * len(triangles), 0.3))
    assert weights.sum() == pytest.approx(1.0)


def test_nodes_that_glide_along_the_surface_are_no_distance() -> None:
    points, triangles = sheet(0.0)
    distances, _ = surface_distances(points, sheet(0.0, middle=0.3)[0], triangles)
    assert distances == pytest.approx(0.0, abs=1e-12)


def test_fine_triangles_have_no_more_weight_than_coarse_ones() -> None:
    """Over a slope dz = x, the mean distance is that of the area, wherever the nodes are crowded."""
    flat, triangles = sheet(0.0, middle=0.1)
    slope = flat + flat[:, :1] * [0.0, 0.0, 0.02]
    distances, weights = surface_distances(flat, slope, triangles)
    assert distances @ weights == pytest.approx(0.01, rel=2e-3)
    assert distances.mean() < 0.009


def test_the_surface_distance_counts_both_directions() -> None:
    """A peak is far from the other sheet in one direction only; both directions give the same distance."""
    points, triangles = sheet(0.0)
    peak = points.copy()
    peak[SIDE * SIDE // 2, 2] = 1.0
    there, back = (surface_distances(*pair, triangles)[0].max() for pair in ((points, peak), (peak, points)))
    assert there == pytest.approx(back)
    assert there == pytest.approx(1.0 / 3.0)
