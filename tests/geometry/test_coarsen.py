"""A coarser mesh of the same wall: equal wall and cavities, and a motion that follows the boundary."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.geometry.coarsen import coarsen
from heartfit.geometry.mesh import Motion
from heartfit.observation.shape import cavity_volumes

PERIOD, PHASES = 0.8, 8


@pytest.fixture(scope="module")
def walls(ventricle):
    """A wall of 1.7 cm that shrinks evenly by 10 %, and its coarse mesh with its motion."""
    fine = replace(ventricle, fibres=None, segments=None)
    sizes = 1.0 - 0.1 * np.sin(np.pi * np.arange(PHASES) / PHASES) ** 2
    motion = Motion(np.arange(PHASES) * PERIOD / PHASES, PERIOD, sizes[:, None, None] * fine.points[None])
    return fine, motion, *coarsen(fine, motion, 0.021, 0.0014)


def test_the_coarse_mesh_has_fewer_tetrahedra_of_the_same_wall(walls):
    fine, _, coarse, _ = walls
    assert len(coarse.tets) < len(fine.tets)
    assert coarse.fibres is not None
    assert coarse.segments is not None


def test_the_cavities_move_alike(walls):
    fine, motion, coarse, carried = walls
    for name, curve in cavity_volumes(fine, motion).items():
        other = cavity_volumes(coarse, carried)[name]
        assert other.values == pytest.approx(curve.values, rel=0.03), name
        # the coarse boundary cuts corners, by the same share in every phase
        assert other.values / other.values[0] == pytest.approx(curve.values / curve.values[0], rel=2e-3)


def test_the_inside_shrinks_with_the_boundary(walls):
    _, _, coarse, carried = walls
    smallest = carried.positions[PHASES // 2]
    assert smallest == pytest.approx(0.9 * coarse.points, abs=3e-4)
