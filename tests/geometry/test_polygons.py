"""Polygons cut at levels: areas by hand, and a tetrahedron's section by its closed form."""

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.geometry.sections import Polygon, clip_polygon, split_into_bands, tetrahedra_sections

TRIANGLE = np.array([[0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 1.0], [0.0, 1.0, 0.0, 0.0]])
"""The field is x."""

TETRAHEDRON = np.vstack([np.zeros(3), np.eye(3)])


def area(polygon: Polygon) -> float:
    p = polygon[:, :3]
    return float(np.linalg.norm(np.cross(p[1:-1] - p[0], p[2:] - p[0]).sum(axis=0)) / 2.0)


def at_level(normal: Floats, offset: float) -> list[Polygon]:
    return list(tetrahedra_sections(TETRAHEDRON, np.arange(4)[None], TETRAHEDRON @ normal - offset))


def test_both_sides_of_a_cut_add_up_to_the_whole() -> None:
    height = TRIANGLE[:, 0] - 0.25
    kept, left = clip_polygon(TRIANGLE, height), clip_polygon(TRIANGLE, -height)
    assert area(kept) == pytest.approx(0.5 * 0.75**2)
    assert area(kept) + area(left) == pytest.approx(0.5)
    assert kept[:, 3] == pytest.approx(kept[:, 0]), "values are split as well"


def test_a_polygon_below_the_plane_is_removed_and_one_above_is_kept() -> None:
    assert len(clip_polygon(TRIANGLE, -np.ones(3))) == 0
    assert clip_polygon(TRIANGLE, np.ones(3)) == pytest.approx(TRIANGLE)


def test_bands_lie_between_their_levels_and_fill_the_polygon() -> None:
    parts = list(split_into_bands(TRIANGLE, 3, np.linspace(-0.2, 1.0, 7)))
    assert [band for band, _ in parts] == [1, 2, 3, 4, 5]
    assert sum(area(part) for _, part in parts) == pytest.approx(0.5)
    for band, part in parts:
        assert part[:, 3].min() >= -0.2 + 0.2 * band - 1e-12
        assert part[:, 3].max() <= 0.2 * band + 1e-12


def test_a_corner_is_cut_off_as_a_triangle() -> None:
    (section,) = at_level(np.ones(3) / np.sqrt(3.0), 0.5 / np.sqrt(3.0))
    assert len(section) == 3
    assert area(section) == pytest.approx(np.sqrt(3.0) / 2.0 * 0.25)


def test_between_two_edges_the_section_is_a_square_and_does_not_cross_itself() -> None:
    (section,) = at_level(np.array([1.0, 1.0, 0.0]) / np.sqrt(2.0), 0.5 / np.sqrt(2.0))
    assert area(section) == pytest.approx(np.sqrt(0.5) * 0.5)


def test_a_plane_beside_the_tetrahedron_gives_no_section() -> None:
    assert at_level(np.array([1.0, 0.0, 0.0]), 2.0) == []
