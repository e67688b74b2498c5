"""A parameter far outside its prior is told, such as the trigger of a beat that starts before the R wave."""

import pytest

import heartfit as hf
from heartfit.discovery.sphere_model import searched_recording as searching
from heartfit.discovery.sphere_model.diagnose import diagnose
from heartfit.discovery.sphere_model.forward_model import candidates

pytestmark = pytest.mark.usefixtures("coarse_search")


@pytest.fixture(autouse=True)
def one_mechanism(monkeypatch):
    """One mechanism is searched, an error of an instrument, which needs no simulation."""
    monkeypatch.setattr(
        searching, "candidates", lambda model: {"CatheterOffset": candidates(model)["CatheterOffset"]}
    )


def recordings():
    """A beat from the R wave on, and the same one with its time as simulated, from atrial systole on."""
    beat = hf.simulate(hf.adult())
    aligned = hf.measure(beat, volume_noise=0.01)
    early = {
        name: hf.Samples(samples.times + beat.trigger, samples.values)
        for name, samples in aligned.curves.items()
    }
    return aligned, hf.Recording(beat.period, early)


def test_a_beat_that_starts_before_the_r_wave_is_told():
    aligned, early = map(diagnose, recordings())
    assert aligned.warnings == ()
    (line,) = [line for line in early.warnings if line.startswith("tissue.control.trigger_delay is fitted ")]
    assert line.endswith("expected at most 4: check that time zero is the R wave")
