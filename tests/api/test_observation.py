"""A calibration by an own loop over the sigma points, through the public names."""

import numpy as np
import pytest

import heartfit as hf

TRUTH = {"sigma_0": 2.2e5, "MitralRegurgitation.area": 5e-5}


@pytest.fixture(scope="module")
def heart():
    return hf.adult() + hf.mechanisms.MitralRegurgitation(area=3e-5)


@pytest.fixture(scope="module")
def recording(heart):
    return hf.measure(hf.simulate(heart.with_parameters(TRUTH)), volume_noise=0.01, seed=1)


def outcomes_of(heart, prior):
    return [hf.observe(hf.simulate(heart.with_parameters(p.parameters))) for p in hf.sigma_points(prior)]


def test_the_loop_recovers_planted_parameters(heart, recording):
    prior = heart.prior({"sigma_0": 0.3, "MitralRegurgitation.area": 0.5})
    noise = hf.observation_noise(recording, 1.5e-6, 100.0)
    posterior = hf.calibrate(prior, outcomes_of(heart, prior), hf.observe(recording), noise)
    table = hf.summary(posterior)
    assert list(table.index) == list(TRUTH)
    assert list(table.prior) == pytest.approx([1.9e5, 3e-5])
    for name, value in TRUTH.items():
        assert table.low[name] < value < table.high[name]
        assert 0.5 < table.informed[name] < 1.0


def test_a_beat_and_its_recording_are_observed_alike(heart):
    beat = hf.simulate(heart)
    assert hf.observe(hf.Recording.from_beat(beat)) == pytest.approx(hf.observe(beat))
    assert hf.observe(hf.curves(beat)) == hf.observe(beat)


def test_sensors_change_what_is_observed(heart):
    beat = hf.simulate(heart)
    shrunk = hf.observe(beat, sensors=[hf.mechanisms.ImageShrinkage(shrinkage=0.1)])
    assert shrunk["V_min"] > hf.observe(beat)["V_min"]
    assert shrunk["P_max"] == hf.observe(beat)["P_max"]


def test_a_failed_beat_is_an_outcome(heart):
    outcome = hf.observe(hf.simulate(heart.with_parameters({"sigma_0": 1e9})))
    assert isinstance(outcome, str)
    assert outcome.startswith("beat 1")


def test_noise_follows_the_observations(recording):
    noise = hf.observation_noise(recording, 1e-6, 100.0)
    assert noise.shape == (6, 6)
    assert list(hf.observe(recording)) == ["V_min", "q_max", "q_min", "P_max", "dPdt_max", "dPdt_min"]
    assert np.sqrt(noise[0, 0]) == pytest.approx(1e-6, rel=0.5)
    assert np.array_equal(noise, np.diag(np.diag(noise)))
    with pytest.raises(hf.InputError, match="expected pressure_sd in Pa"):
        hf.observation_noise(recording, 1e-6)


def test_several_beats_are_averaged_to_one():
    times = np.arange(200) * 0.0203
    values = 1e-4 + 3e-5 * np.cos(2.0 * np.pi * times / 0.8)
    recording = hf.Recording(0.8, {"lv_volume": hf.Samples(times, values)})
    assert hf.observe(recording)["V_min"] == pytest.approx(7e-5, rel=0.02)
    assert recording.curve("lv_volume").times.max() < 0.8
