"""Audit of the blood: the balance closes with valves of all kinds, and a spoilt term shows in it."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.heart.circulation.state import HeartState
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.sphere.body import SphericalBody
from heartfit.mechanisms.aortic_dynamics import AorticDynamics
from heartfit.mechanisms.aortic_regurgitation import AorticRegurgitation
from heartfit.mechanisms.mitral_stenosis import MitralStenosis
from verification.audit_checks import TIGHT, heart_with_valve_dynamics
from verification.blood_audit import BloodAudit, audit_blood

MOVING = heart_with_valve_dynamics().mechanisms


def states_of(heart: Heart, spheres: SphericalBody, time_step: float) -> list[HeartState]:
    histories: list[list[HeartState]] = []
    simulate(
        heart, spheres, Numerics(time_step=time_step, max_beats=1, tolerances=TIGHT), watch=histories.append
    )
    return histories[0]


def audited(heart: Heart, states: list[HeartState]) -> BloodAudit:
    return audit_blood(heart, states, heart.period / (len(states) - 1))


@pytest.mark.parametrize("mechanisms", [(), MOVING, (*MOVING, MitralStenosis(), AorticRegurgitation())])
def test_the_balance_closes_but_for_the_error_in_time(
    mechanisms: tuple, spherical_heart: Heart, spheres: SphericalBody
) -> None:
    heart, errors = spherical_heart, []
    for mechanism in mechanisms:
        heart += mechanism
    for time_step in (5e-3, 2.5e-3):
        blood = audited(heart, states_of(heart, spheres, time_step))
        assert min(blood.lost.values()) > 0.0
        errors.append(abs(blood.remainder) / blood.walls)
    assert errors[0] < 2e-3
    assert errors[1] < 7e-4


def test_valves_without_states_lose_the_work_of_their_resistance(
    spherical_heart: Heart, spheres: SphericalBody
) -> None:
    states = states_of(spherical_heart, spheres, 5e-3)
    blood, dt = audited(spherical_heart, states), spherical_heart.period / (len(states) - 1)
    flows = np.array([state.branches[0] for state in states[1:]])
    for k, (valve, lost) in enumerate(blood.lost.items()):
        law = getattr(spherical_heart.circulation, valve).law()
        conductance = np.where(flows[:, k] > 0.0, law.conductance, law.back_conductance)
        assert lost == pytest.approx(dt * np.sum(flows[:, k] ** 2 / conductance), rel=5e-3)
    assert blood.kinetic == 0.0


def test_kinetic_energy_is_part_of_the_balance_up_to_the_peak_of_ejection(
    spherical_heart: Heart, spheres: SphericalBody
) -> None:
    heart = spherical_heart + AorticDynamics()
    states = states_of(heart, spheres, 2.5e-3)
    peak = np.argmax([0.0, *(state.branches[0, 1] for state in states[1:])])
    blood = audit_blood(heart, states[: peak + 1], heart.period / (len(states) - 1))
    inertance, flow = AorticDynamics().leaflets().inertance, states[peak].branches[0, 1]
    assert blood.kinetic == pytest.approx(0.5 * inertance * flow**2, rel=1e-6)
    assert abs(blood.remainder) < 0.1 * blood.kinetic


@pytest.mark.parametrize("spoilt", ["area", "slowness"])
def test_an_audit_with_another_valve_does_not_close(
    spoilt: str, spherical_heart: Heart, spheres: SphericalBody
) -> None:
    heart = spherical_heart + AorticDynamics()
    states = states_of(heart, spheres, 5e-3)
    other = replace(AorticDynamics(), **{spoilt: 0.5 * getattr(AorticDynamics(), spoilt)})
    blood = audited(spherical_heart + other, states)
    assert abs(blood.remainder) > 0.005 * blood.walls
