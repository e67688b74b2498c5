"""Neighbours of a heart have a stress-free reference of their own only where their relaxed walls differ."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.finite_elements.unloading import unload
from heartfit.heart.heart import Heart
from heartfit.heart.neighbourhood import LoadedHeart, surround
from heartfit.mechanisms.scar import Scar

LOADS = np.array([1000.0, 500.0])
FACTOR = 1.01


def with_factor(name: str) -> Heart:
    value = Heart().parameters()[Heart().parameter_path(name)]
    return Heart().with_parameters({name: FACTOR * value})


@pytest.mark.parametrize(
    ("heart", "loads", "own"),
    [
        (with_factor("sigma_0"), LOADS, False),
        (with_factor("R_p"), LOADS, False),
        (Heart() + Scar(extent=0.1), LOADS, False),
        (with_factor("c_1"), LOADS, True),
        (with_factor("tissue.right.stiffness"), LOADS, True),
        (Heart(), FACTOR * LOADS, True),
    ],
    ids=["contractility", "resistance", "scar", "stiffness", "right stiffness", "load"],
)
def test_a_reference_is_shared_by_walls_that_rest_alike(
    ventricle: VentricularMesh, heart: Heart, loads: Floats, own: bool
) -> None:
    centre = LoadedHeart(Heart(), ventricle, LOADS)
    body, (neighbour,) = surround(centre, [LoadedHeart(heart, ventricle, loads)], 0.01)
    assert (neighbour.body.reference is not body.reference) == own
    expected = unload(ventricle, heart.muscle, loads).points
    assert neighbour.body.reference.points == pytest.approx(expected, abs=4e-6), "to the tolerance of unload"
    assert neighbour.heart is heart
    assert neighbour.size == 0.01


def test_other_fibres_have_another_reference(ventricle: VentricularMesh) -> None:
    turned = replace(ventricle, fibres=np.roll(np.asarray(ventricle.fibres), 1, axis=1), orientation=None)
    centre, other = (LoadedHeart(Heart(), mesh, LOADS) for mesh in (ventricle, turned))
    assert other.wall.rests_like(other.wall)
    assert not other.wall.rests_like(centre.wall)


def test_a_wall_that_is_assumed_stress_free_is_its_own_reference(ventricle: VentricularMesh) -> None:
    centre, stiff = (LoadedHeart(heart, ventricle, LOADS) for heart in (Heart(), with_factor("c_1")))
    body, (neighbour,) = surround(centre, [stiff], 0.01, unloaded=False)
    assert body.reference is neighbour.body.reference is ventricle
