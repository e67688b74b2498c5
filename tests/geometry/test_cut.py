"""A plane cuts a closed surface into closed contours of the right area, on the right side."""

from collections import Counter

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from heartfit.geometry.sections import cut_surface

CORNERS = np.array([[x, y, z] for x in (0.0, 2.0) for y in (0.0, 3.0) for z in (0.0, 5.0)])


def hull(points: np.ndarray) -> np.ndarray:
    """Triangles of the convex hull with outward normals."""
    triangles = ConvexHull(points).simplices
    a, b, c = points[triangles.T]
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), a - points.mean(axis=0)) < 0.0
    return np.where(inward[:, None], triangles[:, ::-1], triangles)


def area(segments: np.ndarray, normal: np.ndarray) -> float:
    return float(np.cross(segments[:, 0], segments[:, 1]).sum(axis=0) @ normal / 2.0)


@pytest.mark.parametrize(
    ("origin", "normal", "expected"),
    [
        ([0.0, 0.0, 1.0], [0.0, 0.0, 1.0], 6.0),
        ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], 6.0),
        ([0.5, 1.0, 1.0], [1.0, 0.0, 0.0], 15.0),
        ([0.0, 0.0, 0.0], [3.0 / 13**0.5, -2.0 / 13**0.5, 0.0], 5.0 * 13**0.5),  # through four corners
        ([0.0, 0.0, 5.5], [0.0, 0.0, 1.0], 0.0),
    ],
)
def test_a_box_is_cut_in_rectangles_that_run_counterclockwise(
    origin: list[float], normal: list[float], expected: float
) -> None:
    segments = cut_surface(CORNERS, hull(CORNERS), np.array(origin), np.array(normal))
    assert area(segments, np.array(normal)) == pytest.approx(expected, abs=1e-12)


def test_contours_are_closed_to_the_bit_and_lie_in_the_plane() -> None:
    rng = np.random.default_rng(4)
    points = rng.standard_normal((300, 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    triangles = hull(points)
    for normal in np.eye(3):
        node = points[np.abs(points @ normal).argmin()]  # lies in the plane, which is nearly the equator's
        segments = cut_surface(points, triangles, node, normal)
        starts, ends = (Counter(map(tuple, segments[:, side])) for side in (0, 1))
        assert starts == ends
        assert np.abs((segments - node) @ normal).max() < 1e-14
        assert 0.95 * np.pi < area(segments, normal) < np.pi
