"""Contours of squares and circles: area, distance, quantile and rays."""

import numpy as np
import pytest

from heartfit.geometry.sections import (
    contour_distances,
    distance_to,
    enclosed_area,
    ray_crossings,
    weighted_quantile,
)

NORMAL = np.array([0.0, 0.6, 0.8])
ACROSS = np.array([[1.0, 0.0, 0.0], [0.0, 0.8, -0.6]])
SHIFT = np.array([5.0, -2.0, 7.0])


def polygon(radius: float, corners: int, centre: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """Segments (n,3) of a regular polygon, counterclockwise about NORMAL, in no order."""
    angle = 2.0 * np.pi * np.arange(corners) / corners
    places = SHIFT + (centre + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)) @ ACROSS
    segments = np.stack([places, np.roll(places, -1, axis=0)], axis=1)
    return np.random.default_rng(corners).permutation(segments)


def test_the_area_of_a_polygon_has_the_sign_of_its_sense() -> None:
    area = 0.5 * 7 * 3.0**2 * np.sin(2.0 * np.pi / 7)
    assert enclosed_area(polygon(3.0, 7), NORMAL) == pytest.approx(area)
    assert enclosed_area(polygon(3.0, 7)[:, ::-1], NORMAL) == pytest.approx(-area)
    hole = np.concatenate([polygon(3.0, 7), polygon(1.0, 7)[:, ::-1]])
    assert enclosed_area(hole, NORMAL) == pytest.approx(area * 8.0 / 9.0)
    assert enclosed_area(np.stack([polygon(3.0, 7)] * 2), NORMAL) == pytest.approx([area, area])


def test_the_distance_is_to_a_side_or_to_a_corner() -> None:
    segment = np.array([[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]]])
    points = np.array([[1.0, 3.0, 0.0], [5.0, 0.0, 4.0], [-3.0, 0.0, 0.0], [0.5, 0.0, 0.0]])
    assert distance_to(points, segment) == pytest.approx([3.0, 5.0, 3.0, 0.0])


@pytest.mark.parametrize("corners", [40, 400])
def test_concentric_circles_are_as_far_apart_as_their_radii(corners: int) -> None:
    """The result does not depend on the sampling: the weights are lengths, half for each circle."""
    distances, weights = contour_distances(polygon(1.0, 200), polygon(1.5, corners))
    assert weights.sum() == pytest.approx(1.0)
    assert weights[:200].sum() == pytest.approx(0.5)
    assert distances @ weights == pytest.approx(0.5, rel=0.01)


def test_the_quantile_of_weighted_values_is_that_of_repeated_ones() -> None:
    values, weights = np.array([3.0, 1.0, 2.0]), np.array([0.2, 0.5, 0.3])
    assert [weighted_quantile(values, weights, share) for share in (0.5, 0.8, 0.81, 1.0)] == [
        1.0,
        2.0,
        3.0,
        3.0,
    ]


def test_rays_cross_a_circle_at_its_radius_and_miss_one_behind() -> None:
    angle = np.linspace(0.0, 2.0 * np.pi, 33)
    directions = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    circle = (polygon(2.0, 500) - SHIFT) @ ACROSS.T
    crossings = ray_crossings(circle, np.zeros(2), directions)
    assert np.isfinite(crossings).sum(axis=1) == pytest.approx(1)
    assert crossings.min(axis=1) == pytest.approx(2.0, rel=1e-4)
    aside = (polygon(2.0, 500, (10.0, 0.0)) - SHIFT) @ ACROSS.T
    crossings = ray_crossings(aside, np.zeros(2), np.array([[1.0, 0.0], [-1.0, 0.0]]))
    assert np.sort(crossings[0])[:2] == pytest.approx([8.0, 12.0], rel=1e-4)
    assert not np.isfinite(crossings[1]).any()
