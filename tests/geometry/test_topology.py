"""Connectivity: orientation, rims and holes of surfaces, compared with counts by hand."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.surface import (
    boundary_faces,
    euler_characteristic,
    neighbours,
    orient,
    require_closed,
    rim_loops,
)

OCTAHEDRON = np.array(
    [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
)


@pytest.mark.parametrize("seed", range(5))
def test_turned_triangles_are_turned_back(seed: int) -> None:
    turn = np.random.default_rng(seed).random(8) < 0.5
    turned = orient(np.where(turn[:, None], OCTAHEDRON[:, ::-1], OCTAHEDRON))
    require_closed(turned)
    assert np.array_equal(np.sort(turned, axis=1), np.sort(OCTAHEDRON, axis=1))


def test_a_sphere_has_euler_characteristic_two_and_every_triangle_three_neighbours() -> None:
    assert euler_characteristic(OCTAHEDRON) == 2
    assert np.bincount(neighbours(OCTAHEDRON).ravel()).tolist() == [3] * 8


def test_the_rim_of_a_cup_runs_once_around_its_opening_in_the_sense_of_the_cup() -> None:
    (loop,) = rim_loops(OCTAHEDRON[:4])
    turn = np.roll(loop, -int(loop.argmin()))
    assert turn.tolist() == [0, 2, 1, 3]


def test_two_cups_that_touch_in_one_node_are_refused_as_pinched() -> None:
    with pytest.raises(InputError, match="pinched"):
        rim_loops(np.array([[0, 1, 2], [0, 3, 4]]))


def test_the_boundary_of_two_tets_leaves_out_the_face_between_them() -> None:
    faces = boundary_faces(np.array([[0, 1, 2, 3], [1, 2, 3, 4]]))
    assert len(faces) == 6
    assert {1, 2, 3} not in map(set, faces.tolist())
