"""Places in the wall and in the circuit of the three-dimensional heart."""

from dataclasses import replace
from functools import reduce
from operator import add

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat
from heartfit.heart.finite_elements.body import FiniteElementBody
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.time_step import TimeStep
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.places import PLACES, Place
from heartfit.places.library import LeakPassage
from heartfit.roles import External, Flow, Mechanism, Narrowing, Pressure, Sensor

BLOOD = (External, Flow, Narrowing, Pressure)
IN_CIRCUIT = [place for place in PLACES if issubclass(place, BLOOD)]
IN_WALL = [place for place in PLACES if not issubclass(place, (*BLOOD, Sensor))]
HEART = Heart()
STEPS = 20


def at(place: type[Place], z: float) -> Place:
    return place.from_standardised(np.full(place.size, z), HEART.period)


def curves(beat: Beat) -> dict[str, Floats]:
    assert beat.completed
    return {name: values for name, values in beat.signals().items() if "_" in name}


def test_places_at_zero_change_no_bit_of_a_beat_and_a_leak_is_that_of_its_mechanism(
    coarse_body: FiniteElementBody,
) -> None:
    few = Numerics(time_step=0.02, max_beats=1)

    def beat(*mechanisms: Mechanism) -> dict[str, Floats]:
        return curves(simulate(replace(HEART, mechanisms=mechanisms), coarse_body, few))

    plain, off = beat(), beat(*(at(place, 0.0) for place in IN_CIRCUIT))
    leak, mechanism = beat(LeakPassage(0.0, 0.3e-4)), beat(MitralRegurgitation(0.3e-4))
    for name, values in plain.items():
        np.testing.assert_array_equal(off[name], values)
        np.testing.assert_array_equal(leak[name], mechanism[name])
    assert np.abs(leak["lv_volume"] - plain["lv_volume"]).max() > 1e-6


def forces(body: FiniteElementBody, x: Floats) -> Floats:
    """Internal forces of a body that oscillates by ``x`` once in a period."""
    state, length, result = body.rest(), HEART.period / STEPS, []
    for n in range(STEPS):
        step = body.step(state, TimeStep(n * length, length, HEART.period, True, length if n else None))
        displaced = np.sin(2.0 * np.pi * (n + 1) / STEPS) * x
        result.append(step.forces(displaced))
        state = step.commit(displaced)
    return np.array(result)


@pytest.mark.parametrize("place", IN_WALL)
def test_a_place_in_the_wall_at_zero_changes_no_bit_of_the_forces(
    place: type[Place], ventricle: VentricularMesh
) -> None:
    x = np.zeros((len(ventricle.points), 4))
    turn = np.array([[0.0, 0.1, 0.05], [0.05, 0.0, 0.1], [0.1, 0.05, 0.0]])
    x[:, :3] = (ventricle.points - ventricle.points.mean(axis=0)) @ turn
    hearts = [HEART, HEART + at(place, 0.0), HEART + at(place, 0.5)]
    without, off, on = (forces(FiniteElementBody(ventricle, heart.muscle), x) for heart in hearts)
    np.testing.assert_array_equal(off, without)
    assert np.abs(on - without).max() > 1e-3 * np.abs(without).max()


def test_every_place_acts_in_the_circuit_in_the_wall_or_in_the_measurement() -> None:
    measured = [place for place in PLACES if issubclass(place, Sensor)]
    assert len(IN_CIRCUIT) + len(IN_WALL) + len(measured) == len(PLACES)
    assert reduce(add, (at(place, 0.1) for place in PLACES), HEART).mechanisms
