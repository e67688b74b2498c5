"""Forward model of the search: nominal heart, size, and instruments that need no beat."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.discovery.inference.hypothesis import CountedHypothesis
from heartfit.discovery.sphere_model import forward_model
from heartfit.discovery.sphere_model.forward_model import NUMERICS, SphereForwardModel, candidates, hypothesis
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS
from heartfit.discovery.sphere_model.nominal_heart import ADULT, WITH_RIGHT, perturb
from heartfit.discovery.sphere_model.recording import Recording, Samples
from heartfit.heart.finite_elements.kinematics import StepFailed
from heartfit.mechanisms.catheter_offset import CatheterOffset
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation

TIMES = {"lv_volume": np.arange(26) / 30, "lv_pressure": np.arange(86) / 100}
CENTRE = np.zeros(len(FREE_PARAMETERS))


def test_the_centre_is_a_human_heart():
    volume, pressure = np.split(SphereForwardModel(ADULT, TIMES).predict(CENTRE, ()), [26])
    assert volume.max() == pytest.approx(ADULT.filled, rel=0.02)
    assert 40e-6 < volume.min() < 60e-6
    assert 14e3 < pressure.max() < 18e3


def test_size_changes_volumes_and_no_pressure():
    frames = np.arange(26) / 30
    large = Recording(
        ADULT.heart.period, {"lv_volume": Samples(frames, 2.0 * ADULT.filled * np.repeat([0.4, 1.0], 13))}
    )
    small, twice = (SphereForwardModel(heart, TIMES) for heart in (ADULT, ADULT.scaled_to(large)))
    ratio = twice.predict(CENTRE, ()) / small.predict(CENTRE, ())
    assert ratio[:26] == pytest.approx(2.0, rel=1e-3)  # the mass of the wall alone breaks the similarity
    assert ratio[26:] == pytest.approx(1.0, rel=0.1)


def test_an_instrument_costs_no_simulation_and_a_mechanism_does():
    model = SphereForwardModel(ADULT, TIMES)
    true = model.predict(CENTRE, ())
    offset = model.predict(CENTRE, (CatheterOffset(500.0),))
    assert model.simulations == 1
    assert offset[26:] - true[26:] == pytest.approx(500.0)
    assert np.array_equal(model.predict(CENTRE, (MitralRegurgitation(0.0),)), true)
    leaking = model.predict(CENTRE, (MitralRegurgitation(3e-5),))
    assert model.simulations == 3
    assert leaking[26:].max() < true[26:].max()


def test_the_trigger_moves_the_recording_and_not_the_heart():
    model, late = SphereForwardModel(ADULT, TIMES), CENTRE.copy()
    late[-1] = 1.0
    model.predict(CENTRE, ())
    shifted = SphereForwardModel(
        ADULT, {name: at + FREE_PARAMETERS[-1].person for name, at in TIMES.items()}
    ).predict(CENTRE, ())
    assert model.predict(late, ()) == pytest.approx(shifted, rel=1e-9)
    assert model.simulations == 1


@pytest.mark.parametrize("effects", [(), ("MitralRegurgitation",), ("Scar",)], ids=str)
def test_slopes_are_those_of_the_limit_cycle_to_a_five_hundredth_of_the_noise(monkeypatch, effects):
    noise = np.repeat([1e-6, 133.0], [26, 86])
    library = candidates(SphereForwardModel(ADULT, TIMES))
    added = [library[name] for name in effects]
    rng = np.random.default_rng(3)
    x = 0.7 * rng.standard_normal(len(FREE_PARAMETERS))
    own = 0.7 * np.abs(rng.standard_normal(sum(len(candidate.unknowns) for candidate in added)))
    x = np.concatenate([x, own])

    def slopes(relaxed: bool):
        tried = hypothesis(SphereForwardModel(ADULT, TIMES), added)
        counted = CountedHypothesis(replace(tried, near=lambda x: None) if relaxed else tried)
        counted(counted.hypothesis.at(0.5))  # a search has simulated another heart before
        return counted.jacobian(x, counted(x))

    searched = slopes(relaxed=False)
    monkeypatch.setattr(forward_model, "NUMERICS", replace(NUMERICS, drift=1e-9, max_beats=80))
    assert np.abs((searched - slopes(relaxed=True)) / noise[:, None]).max() < 0.002


def test_beats_of_slopes_take_few_iterations():
    model = SphereForwardModel(ADULT, TIMES)
    near = model.near(CENTRE, ())
    shifted = CENTRE + 0.02 * (np.arange(len(CENTRE)) == 5)
    costs = [m.simulate(shifted)[1].diagnostics["iterations"] for m in (near, model)]
    assert costs[0] < 0.5 * costs[1]
    assert model.simulations == near.simulations == 3


def test_every_free_parameter_acts_on_a_nominal_heart_without_length_dependence():
    centre = replace(ADULT, heart=ADULT.heart.with_parameters({"slope": 0.0}))
    model = SphereForwardModel(centre, TIMES)
    beat = model.predict(CENTRE, ())
    for index, parameter in enumerate(FREE_PARAMETERS):
        shifted = model.predict(np.where(np.arange(len(FREE_PARAMETERS)) == index, 1.0, 0.0), ())
        assert np.abs(shifted / beat - 1.0).max() > 1e-3, parameter.name


def test_coordinates_outside_the_admissible_range_have_no_prediction():
    assert (
        SphereForwardModel(ADULT, TIMES).predict(
            np.where(np.arange(len(FREE_PARAMETERS)) == len(FREE_PARAMETERS) - 3, 60.0, 0.0), ()
        )
        is None
    )


def test_a_heart_whose_responses_cannot_be_measured_has_no_neighbours(monkeypatch):
    def fails(*_args: object) -> None:
        raise StepFailed("a step has no solution")

    monkeypatch.setattr(forward_model, "Neighbours", fails)
    assert SphereForwardModel(ADULT, TIMES).near(CENTRE, ()) is None


@pytest.mark.parametrize("nominal", [ADULT, WITH_RIGHT], ids=["left", "both"])
def test_a_heart_near_another_is_the_one_from_the_nominal_heart(nominal):
    rng = np.random.default_rng(5)
    x = 0.7 * rng.standard_normal(len(nominal.free))
    centre = perturb(nominal, x)
    for shift in np.diag(np.full(x.size, 0.02)):
        near, anew = perturb(nominal, x + shift, centre.heart), perturb(nominal, x + shift)
        assert near == anew != centre
