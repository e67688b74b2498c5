"""A recorded aortic pressure enters the search: as a curve of its own, with its noise, and it speaks for a stenosis."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.diagnosis import case as searching
from heartfit.diagnosis import library
from heartfit.diagnosis.case import Case
from heartfit.diagnosis.centre import HUMAN
from heartfit.diagnosis.free import FREE
from heartfit.diagnosis.record import PRESSURE_LEVELS, data_of
from heartfit.diagnosis.recording import Recording, Samples
from heartfit.diagnosis.twin import Twin
from heartfit.mechanisms.aortic_stenosis import AorticStenosis
from heartfit.mechanisms.catheter_offset import CatheterOffset
from heartfit.observation.beat import beat_curves
from heartfit.planting.hidden import draw_hidden
from heartfit.planting.measuring import Study, measured


def one(twin: Twin) -> dict[str, library.Candidate]:
    return {"AorticStenosis": library.candidates(twin)["AorticStenosis"]}


@pytest.fixture(scope="module")
def stenosed() -> Recording:
    """A heart of another model with a narrowed valve, its three curves."""
    rng = np.random.default_rng(742)
    hidden = draw_hidden(rng).with_effects([AorticStenosis(AorticStenosis.switch().at(1.0))])
    beat = hidden.beat()
    aorta = beat_curves(beat)["aorta_pressure"].resampled(86)
    curves = measured(beat, (), Study.draw(rng), rng)
    samples = {name: Samples(curve.times, curve.values) for name, curve in curves.items()}
    noisy = aorta.values + 100.0 * rng.standard_normal(86)
    return Recording(aorta.period, {**samples, "aorta_pressure": Samples(aorta.times, noisy)})


def test_it_is_a_block_with_the_noise_of_a_catheter(stenosed):
    *_, aorta = data_of(stenosed).blocks
    assert (aorta.curve, aorta.unit) == ("aorta_pressure", "Pa")
    assert aorta.noise.levels == pytest.approx(PRESSURE_LEVELS, rel=0.01)


def test_the_catheter_in_the_ventricle_does_not_act_on_it():
    times = {"lv_pressure": np.arange(20) * 0.04, "aorta_pressure": np.arange(20) * 0.04}
    twin, centre = Twin(HUMAN, times), np.zeros(len(FREE))
    moved = twin.predicted(centre, (CatheterOffset(500.0),)) - twin.predicted(centre, ())
    assert moved == pytest.approx(np.repeat([500.0, 0.0], 20))


def test_it_speaks_for_a_stenosis(stenosed, monkeypatch):
    monkeypatch.setattr(searching, "candidates", one)
    ventricle = {name: each for name, each in stenosed.curves.items() if name != "aorta_pressure"}
    without, found = (Case.searched(each) for each in (replace(stenosed, curves=ventricle), stenosed))
    assert found.verdict == "named"
    assert found.ranking()["AorticStenosis"] > without.ranking()["AorticStenosis"] + 3.0
