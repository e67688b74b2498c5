"""An inverted tetrahedron regains some volume; all other nodes stay."""

import numpy as np
import pytest

from heartfit.geometry.cube import cube
from heartfit.geometry.mesh import VentricularMesh, element_volumes
from heartfit.imaging.registration.track import MAX_RELAXED_SHARE, MIN_VOLUME_RATIO, unfold

EDGE = 8e-3


@pytest.fixture(scope="module")
def block() -> VentricularMesh:
    return cube(8, EDGE)


def pushed(block: VentricularMesh, nodes: int) -> np.ndarray:
    """All nodes shifted equally, and those in the middle pushed through their neighbours."""
    places = block.points + np.array([3e-3, 0.0, -1e-3])
    near = np.argsort(np.linalg.norm(block.points - 0.5 * EDGE, axis=1))[:nodes]
    places[near] += np.array([1.7e-3, 0.4e-3, 0.0])
    return places


def compression(block: VentricularMesh, places: np.ndarray) -> float:
    return float((element_volumes(places, block.tets) / block.element_volumes()).min())


def test_one_node_that_folds_the_wall_is_moved_back(block: VentricularMesh) -> None:
    places = pushed(block, 1)
    assert compression(block, places) < 0.0
    unfolded = unfold(block, places)
    assert compression(block, unfolded) >= MIN_VOLUME_RATIO
    otherwise = (unfolded != places).any(axis=1)
    assert 0 < otherwise.sum() < MAX_RELAXED_SHARE * len(places)
    assert abs(unfolded - block.points - np.array([3e-3, 0.0, -1e-3])).max() < 1.7e-3, (
        "it moves towards its neighbours"
    )


def test_unfolded_nodes_are_unchanged_to_the_bit(block: VentricularMesh) -> None:
    places = block.points @ np.diag([1.1, 0.8, 1.0])
    np.testing.assert_array_equal(unfold(block, places), places)


def test_a_displacement_that_folds_much_of_the_wall_is_unchanged(block: VentricularMesh) -> None:
    places = pushed(block, 200)
    np.testing.assert_array_equal(unfold(block, places), places)
