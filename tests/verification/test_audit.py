"""Audit: forces are the derivatives of the energies; a spoilt term shows in the balance."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.geometry.cube import cube
from heartfit.heart.beat import Beat
from heartfit.heart.finite_elements.body import FiniteElementBody, Tissue
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics, simulate
from heartfit.heart.sphere.body import SphericalBody
from heartfit.mechanisms.mitral_dynamics import MitralDynamics
from tests.shrinking import assert_derivative
from verification.audit import audit, energies, isovolumic_drift, lost_blood
from verification.audit_checks import LONG_STEP, SMALL, TIGHT, max_relative_difference, reference, watched


@pytest.mark.parametrize("element", ["p1", "mixed"])
def test_static_forces_are_the_derivative_of_what_is_stored(element: str) -> None:
    body = FiniteElementBody(cube(2, 0.04), Tissue(element=element))
    step, rng = body.static_step(body.rest()), np.random.default_rng(2)
    scale = np.append(np.full(3, 5e-4), np.full(body.element.dofs - 3, 1e3))
    x, direction = (scale * rng.standard_normal(body.rest().x.shape) for _ in range(2))

    def stored(z: np.ndarray) -> float:
        step.forces(z.reshape(x.shape))
        energy = energies(body, step.commit(z.reshape(x.shape)))
        return energy["shape"] + energy["volume"] + energy["supports"]

    slope = step.forces(x) @ direction.ravel()
    assert_derivative(stored, np.array(slope), x.ravel(), direction.ravel())


@pytest.mark.parametrize(
    "spoilt", ["sigma_0", "k_0", "alpha", "mu", "c_1", "c_2", "eta", "k_b", "c_b", "k_p"]
)
def test_an_audit_with_other_parameters_does_not_close(spoilt: str) -> None:
    """The remainder moves by the share of the parameter; round-off of the same states is below 1e-12."""
    watched_beat = watched(LONG_STEP)
    heart = Heart()
    value = heart.parameters()[heart.parameter_path(spoilt)]
    body = FiniteElementBody(reference(), heart.with_parameters({spoilt: 3.0 * value}).tissue)
    other = audit(body, watched_beat.states, heart.period)
    assert abs(other.remainder - watched_beat.audit.remainder) > 1e-8 * watched_beat.audit.ejecting


def test_the_fibres_close_with_the_series_spring_and_not_without() -> None:
    watched_beat = watched(LONG_STEP)
    tissue = Heart().with_parameters({"E_s": 3.1e7}).tissue
    other = audit(FiniteElementBody(reference(), tissue), watched_beat.states, Heart().period)
    assert (
        abs(other.fibre_gap)
        > 100 * SMALL * watched_beat.audit.ejecting
        > 100 * abs(watched_beat.audit.fibre_gap)
    )


def test_lost_blood_is_located() -> None:
    states = list(watched(LONG_STEP).states)
    states[-1] = replace(states[-1], volumes=states[-1].volumes - np.array([0.0, 1e-9]))
    assert lost_blood(Heart(), states) == pytest.approx([0.0, -1e-9, 0.0, 0.0], abs=1e-13)


def test_a_valve_with_states_conserves_blood(spherical_heart: Heart, spheres: SphericalBody) -> None:
    """Blood that flows back while the leaflets close is counted; without the states of the valve it would be lost."""
    heart, histories = spherical_heart + MitralDynamics(), []
    simulate(heart, spheres, Numerics(max_beats=1, tolerances=TIGHT), watch=histories.append)
    (states,) = histories
    assert lost_blood(heart, states) == pytest.approx(np.zeros(4), abs=1e-14)
    forgetful = [replace(state, branches=None) for state in states]
    assert abs(lost_blood(heart, forgetful)).max() > 1e-6


def test_isovolumic_drift_is_the_worst_phase() -> None:
    """Two phases of the left ventricle, 2 and 3 mL; the right one has flow all the time."""
    flow = np.array([1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0])
    volume = np.array([90.0, 100.0, 101.0, 102.0, 80.0, 60.0, 50.0, 47.0, 70.0])
    none, some = np.zeros(9), np.ones(9)
    flows = {"mitral": flow, "aortic": none, "tricuspid": some, "pulmonary": none}
    beat = Beat(np.arange(9.0), {"lv": volume, "rv": volume}, {}, flows, 8.0, 0.0)
    assert isovolumic_drift(beat) == pytest.approx(3.0)


def test_curves_are_compared_by_their_largest_value() -> None:
    first, second = {"V": np.array([0.0, 4.0])}, {"V": np.array([1.0, 4.0])}
    assert max_relative_difference(first, second) == pytest.approx(0.25)
