"""A recorded aortic pressure enters the search as a curve with its noise and raises the evidence of a stenosis."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.discovery.sphere_model import forward_model as library
from heartfit.discovery.sphere_model import searched_recording as searching
from heartfit.discovery.sphere_model.forward_model import SphereForwardModel
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS
from heartfit.discovery.sphere_model.nominal_heart import ADULT
from heartfit.discovery.sphere_model.recording import PRESSURE_LEVELS, Recording, Samples, search_data
from heartfit.discovery.sphere_model.searched_recording import SearchedRecording
from heartfit.mechanisms.aortic_stenosis import AorticStenosis
from heartfit.mechanisms.catheter_offset import CatheterOffset
from heartfit.observation.beat import beat_curves
from heartfit.synthetic.hidden import RecordingProtocol, draw_hidden, measure_beat


def one(model: SphereForwardModel) -> dict[str, library.Candidate]:
    return {"AorticStenosis": library.candidates(model)["AorticStenosis"]}


@pytest.fixture(scope="module")
def stenosed() -> Recording:
    """A heart of another model with a narrowed valve, its three curves."""
    rng = np.random.default_rng(742)
    hidden = draw_hidden(rng).with_effects([AorticStenosis(AorticStenosis.switch().at(1.0))])
    beat = hidden.beat()
    aorta = beat_curves(beat)["aorta_pressure"].resampled(86)
    curves = measure_beat(beat, (), RecordingProtocol.draw(rng), rng)
    samples = {name: Samples(curve.times, curve.values) for name, curve in curves.items()}
    noisy = aorta.values + 100.0 * rng.standard_normal(86)
    return Recording(aorta.period, {**samples, "aorta_pressure": Samples(aorta.times, noisy)})


def test_aortic_pressure_is_a_block_with_the_noise_of_a_catheter(stenosed):
    *_, aorta = search_data(stenosed).blocks
    assert (aorta.curve, aorta.unit) == ("aorta_pressure", "Pa")
    assert aorta.noise.levels == pytest.approx(PRESSURE_LEVELS, rel=0.01)


def test_the_catheter_in_the_ventricle_does_not_act_on_it():
    times = {"lv_pressure": np.arange(20) * 0.04, "aorta_pressure": np.arange(20) * 0.04}
    model, centre = SphereForwardModel(ADULT, times), np.zeros(len(FREE_PARAMETERS))
    change = model.predict(centre, (CatheterOffset(500.0),)) - model.predict(centre, ())
    assert change == pytest.approx(np.repeat([500.0, 0.0], 20))


@pytest.mark.usefixtures("coarse_search")
def test_aortic_pressure_raises_the_evidence_of_a_stenosis(stenosed, monkeypatch):
    monkeypatch.setattr(searching, "candidates", one)
    ventricle = {name: curve for name, curve in stenosed.curves.items() if name != "aorta_pressure"}
    without, complete = (
        SearchedRecording.search(recording) for recording in (replace(stenosed, curves=ventricle), stenosed)
    )
    assert complete.verdict == "named"
    assert complete.ranking()["AorticStenosis"] > without.ranking()["AorticStenosis"] + 3.0
