"""Measurements of a hidden heart: errors have their stated sizes and correlation times."""

import numpy as np
import pytest

from heartfit.synthetic import hidden as measuring
from heartfit.synthetic.hidden import (
    RecordingProtocol,
    autoregressive_error,
    draw_hidden,
    measure_beat,
    smooth_process,
)

BEAT = draw_hidden(np.random.default_rng(1)).beat()


def test_errors_of_neighbouring_frames_correlate_as_stated():
    error = autoregressive_error(40000, 0.6, np.random.default_rng(0))
    assert error.std() == pytest.approx(1.0, abs=0.02)
    for lag in (1, 2):
        assert np.mean(error[lag:] * error[:-lag]) == pytest.approx(0.6**lag, abs=0.03)


def test_roughness_has_variance_one_its_length_and_the_period():
    rng, times = np.random.default_rng(0), np.array([0.0, 0.05, 0.86])
    drawn = np.array([smooth_process(times, 0.86, 0.05, rng) for _ in range(4000)])
    correlation = np.corrcoef(drawn.T)
    assert drawn.std(axis=0) == pytest.approx(1.0, abs=0.05)
    assert correlation[0, 1] == pytest.approx(np.exp(-0.5), abs=0.1)
    assert correlation[0, 2] == pytest.approx(1.0, abs=1e-9)


def test_a_study_draws_frames_and_noise_within_their_bounds():
    studies = [RecordingProtocol.draw(np.random.default_rng(seed)) for seed in range(100)]
    assert {study.frames for study in studies} == set(range(25, 31))
    assert all(0.01 <= study.noise <= 0.03 for study in studies)


def test_curves_are_the_beat_with_errors_of_the_stated_size(monkeypatch):
    study, rng = RecordingProtocol(28, 0.02), np.random.default_rng(0)
    measured = [measure_beat(BEAT, (), study, rng) for _ in range(60)]
    monkeypatch.setattr(measuring, "PRESSURE_NOISE", 0.0)
    monkeypatch.setattr(measuring, "VOLUME_ROUGHNESS", 0.0)
    monkeypatch.setattr(measuring, "PRESSURE_ROUGHNESS", 0.0)
    true = measure_beat(BEAT, (), RecordingProtocol(28, 0.0), rng)
    volume = np.array([curves["lv_volume"].values for curves in measured]) - true["lv_volume"].values
    pressure = np.array([curves["lv_pressure"].values for curves in measured]) - true["lv_pressure"].values
    expected = np.hypot(0.02 * BEAT.volume["lv"].max(), 0.6e-6)
    assert len(true["lv_volume"].values) == 28
    assert volume.std() == pytest.approx(expected, rel=0.1)
    assert pressure.std() == pytest.approx(np.hypot(300.0 / np.sqrt(10.0), 150.0), rel=0.1)
    assert np.diff(true["lv_pressure"].times) == pytest.approx(0.01)
