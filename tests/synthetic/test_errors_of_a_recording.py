"""Errors of a planted recording have the statistics that they are declared to have."""

import numpy as np
import pytest

from heartfit.observation.curve import Curve
from heartfit.synthetic import hidden as module
from heartfit.synthetic.hidden import (
    MEMORY,
    NOMINAL,
    RELATIVE,
    RecordingProtocol,
    autoregressive_error,
    draw_hidden,
    measure_beat,
    record_pressure,
    smooth_process,
)

PERIOD = 0.86
TIMES = np.arange(86) * PERIOD / 86


def test_errors_of_frames_have_variance_one_and_the_correlation_of_neighbours():
    error = autoregressive_error(20_000, MEMORY, np.random.default_rng(0))
    assert error.std() == pytest.approx(1.0, abs=0.03)
    assert np.mean(error[1:] * error[:-1]) == pytest.approx(MEMORY, abs=0.03)


def test_the_discrepancy_of_every_model_has_variance_one_and_is_periodic():
    rng, at = np.random.default_rng(0), np.array([0.1, 0.4, 0.1 + PERIOD])
    draws = np.array([smooth_process(at, PERIOD, 0.05, rng) for _ in range(3000)])
    assert draws.var(axis=0) == pytest.approx(np.ones(3), abs=0.1)
    assert draws[:, 2] == pytest.approx(draws[:, 0])


def test_a_catheter_gives_means_of_ten_samples(monkeypatch):
    monkeypatch.setattr(module, "PRESSURE_ROUGHNESS", 0.0)
    steady, rng = Curve(TIMES, np.full(86, 10e3), PERIOD), np.random.default_rng(0)
    recorded = [record_pressure(steady, rng) for _ in range(20)]
    assert recorded[0].times == pytest.approx(0.0045 + 0.010 * np.arange(86))
    errors = np.concatenate([curve.values - 10e3 for curve in recorded])
    assert errors.std() == pytest.approx(300.0 / np.sqrt(10.0), rel=0.05)


@pytest.mark.parametrize("noise", [0.01, 0.03])
def test_the_noise_of_a_volume_is_a_share_of_its_end_diastolic_value(monkeypatch, noise):
    monkeypatch.setattr(module, "VOLUME_ROUGHNESS", 0.0)
    volume = Curve(TIMES, 100e-6 + 50e-6 * np.cos(2.0 * np.pi * TIMES / PERIOD), PERIOD)
    pressure = Curve(TIMES, np.full(86, 10e3), PERIOD)
    monkeypatch.setattr(module, "beat_curves", lambda *_: {"lv_volume": volume, "lv_pressure": pressure})
    rng, protocol = np.random.default_rng(0), RecordingProtocol(28, noise)
    frames = [measure_beat(None, (), protocol, rng)["lv_volume"] for _ in range(60)]
    errors = np.concatenate([curve.values - volume(curve.times) for curve in frames])
    assert frames[0].times.size == 28
    assert errors.std() == pytest.approx(noise * 150e-6, rel=0.1)


def test_a_hidden_heart_lies_at_its_deviates():
    hidden = draw_hidden(np.random.default_rng(5))
    values = hidden.heart.parameters()
    contractility = values[hidden.heart.parameter_path("sigma_0")]
    factor = np.exp(RELATIVE["sigma_0"] * hidden.deviates["sigma_0"])
    assert abs(factor - 1.0) > 0.01
    assert contractility == pytest.approx(NOMINAL["sigma_0"] * factor)


def test_raised_legs_multiply_the_filling_pressure():
    hidden = draw_hidden(np.random.default_rng(5))
    raised = hidden.with_preload(1.4).heart.circulation
    assert raised.left_atrium == pytest.approx(1.4 * hidden.heart.circulation.left_atrium)
