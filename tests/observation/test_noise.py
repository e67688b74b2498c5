"""Planted noise is recovered and propagates to the observations with its theoretical size."""

import numpy as np
import pytest

from heartfit.observation.curve import Curve
from heartfit.observation.measurement import frame_noise, measure
from heartfit.observation.operator import VolumeFeatures

PERIOD = 0.829
TIMES = np.arange(25) * PERIOD / 25
SMOOTH = 120e-6 + 50e-6 * np.cos(2 * np.pi * TIMES / PERIOD) + 10e-6 * np.sin(6 * np.pi * TIMES / PERIOD)


def test_a_band_limited_curve_has_no_noise() -> None:
    assert frame_noise(Curve(TIMES, SMOOTH, PERIOD)) == pytest.approx(0, abs=1e-12)


def test_planted_noise_is_recovered() -> None:
    random = np.random.default_rng(3)
    deviations = [
        frame_noise(Curve(TIMES, SMOOTH + 1.3e-6 * random.standard_normal(25), PERIOD)) for _ in range(200)
    ]
    assert np.sqrt(np.mean(np.square(deviations))) == pytest.approx(1.3e-6, rel=0.05)


def test_observations_carry_the_noise_of_a_central_difference() -> None:
    """One steep step has its peak slope in one frame, where theory is exact."""
    step = SMOOTH + 40e-6 * (TIMES[20] < TIMES)
    observations = {
        o.name: o for o in measure(VolumeFeatures(), Curve(TIMES, step, PERIOD), noise=1e-7, draws=4000)
    }
    rate_noise = 1e-7 * np.sqrt(2) / (2 * PERIOD / 25)
    expected = np.hypot(rate_noise, 0.05 * abs(observations["q_min"].value))
    assert observations["q_min"].noise == pytest.approx(expected, rel=0.05)
    assert observations["V_min"].unit == "m^3"


def test_period_uncertainty_scales_rates_and_leaves_volumes() -> None:
    observations = {o.name: o for o in measure(VolumeFeatures(), Curve(TIMES, SMOOTH, PERIOD), noise=0.0)}
    assert observations["V_min"].noise == pytest.approx(0, abs=1e-12)
    assert observations["q_max"].noise / observations["q_max"].value == pytest.approx(0.05, rel=0.1)


def test_the_same_seed_gives_the_same_noise() -> None:
    curve = Curve(TIMES, SMOOTH, PERIOD)
    assert measure(VolumeFeatures(), curve, noise=1e-6) == measure(VolumeFeatures(), curve, noise=1e-6)
