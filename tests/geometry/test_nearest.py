"""The nearest point of a triangle: inside, on an edge, at a corner, and on the right side of a thin wall."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from heartfit.geometry.carry import closest_weights, nearest_on_surface

TRIANGLE = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])


@pytest.mark.parametrize(
    ("query", "foot"),
    [
        ([0.25, 0.25, 3.0], [0.25, 0.25, 0.0]),
        ([0.5, -2.0, 1.0], [0.5, 0.0, 0.0]),
        ([2.0, 2.0, 0.0], [0.5, 0.5, 0.0]),
        ([-1.0, -1.0, 0.0], [0.0, 0.0, 0.0]),
    ],
)
def test_the_closest_point_of_a_triangle(query: list[float], foot: list[float]) -> None:
    assert closest_weights(np.array(query), TRIANGLE) @ TRIANGLE == pytest.approx(np.array(foot))


@settings(max_examples=50, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_no_point_of_the_triangle_is_closer(seed: int) -> None:
    rng = np.random.default_rng(seed)
    corners, query = rng.standard_normal((3, 3)), 2.0 * rng.standard_normal(3)
    foot = closest_weights(query, corners) @ corners
    others = rng.dirichlet(np.ones(3), 200) @ corners
    assert np.linalg.norm(foot - query) <= np.linalg.norm(others - query, axis=1).min() + 1e-12


def test_the_near_side_of_a_thin_wall_is_selected() -> None:
    points = np.vstack([TRIANGLE, TRIANGLE - [0, 0, 0.1]])
    sheets = np.array([[0, 1, 2], [3, 5, 4]])
    query, down = np.array([[0.2, 0.2, -0.01]]), np.array([[0.0, 0.0, -1.0]])
    assert nearest_on_surface(query, points, sheets)[0].tolist() == [0]
    assert nearest_on_surface(query, points, sheets, down)[0].tolist() == [1]
