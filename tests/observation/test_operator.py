"""Observations of curves with extrema in closed form."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some
from scipy.signal import savgol_filter

from heartfit.observation.curve import Curve
from heartfit.observation.operator import PressureFeatures, VolumeFeatures

PERIOD = 0.8
MEAN, AMPLITUDE = 120e-6, 50e-6
OMEGA = 2 * np.pi / PERIOD


def cosine(samples: int, phase: float = 0.0) -> Curve:
    times = np.arange(samples) * PERIOD / samples
    return Curve(times, MEAN + AMPLITUDE * np.cos(OMEGA * times + phase), PERIOD)


def test_extrema_of_a_cosine_converge_with_second_order() -> None:
    exact = np.array([MEAN - AMPLITUDE, AMPLITUDE * OMEGA, -AMPLITUDE * OMEGA])
    errors = []
    for frames in (24, 48, 96):
        observations = VolumeFeatures(frames=frames)(cosine(frames))
        errors.append(abs(observations["q_max"] - exact[1]) / exact[1])
        assert observations["V_min"] == pytest.approx(exact[0], rel=1e-12)
        assert observations["q_min"] == pytest.approx(-observations["q_max"], rel=1e-9)
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx(2, abs=0.05)


def test_window_three_is_the_raw_central_difference() -> None:
    times = np.arange(25) * PERIOD / 25
    values = np.random.default_rng(1).uniform(80e-6, 180e-6, 25)
    slope = (np.roll(values, -1) - np.roll(values, 1)) / (2 * PERIOD / 25)
    observations = VolumeFeatures(frames=25)(Curve(times, values, PERIOD))
    assert list(observations.values()) == pytest.approx([values.min(), slope.max(), slope.min()], rel=1e-9)


@pytest.mark.parametrize(("window", "order"), [(3, 1), (5, 2), (7, 3), (25, 4), (25, 6)])
def test_the_filter_is_the_periodic_one_of_scipy(window: int, order: int) -> None:
    features, curve = VolumeFeatures(25, window, order), cosine(25, phase=0.3)
    for derivative, filtered in enumerate((features.smooth(curve), features.rate(curve))):
        expected = savgol_filter(
            curve.values, window, order, deriv=derivative, delta=PERIOD / 25, mode="wrap"
        )
        assert filtered.values == pytest.approx(expected, rel=1e-6, abs=1e-6 * np.ptp(expected))


@given(turn=some.integers(0, 24), seed=some.integers(0, 100))
def test_observations_do_not_depend_on_which_frame_is_first(turn: int, seed: int) -> None:
    values = np.random.default_rng(seed).uniform(80e-6, 180e-6, 25)
    times = np.arange(25) * PERIOD / 25
    operator = VolumeFeatures(window=7, order=4)
    first, turned = (
        operator(Curve(times, values, PERIOD)),
        operator(Curve(times, np.roll(values, turn), PERIOD)),
    )
    assert list(turned.values()) == pytest.approx(list(first.values()), rel=1e-9)


def test_a_dense_curve_is_observed_at_the_measured_frames() -> None:
    """The same heart sampled finely must give what its 25 frames give, not its own steeper peak."""
    dense, frames = cosine(800, phase=0.3), cosine(25, phase=0.3)
    operator = VolumeFeatures(frames=25)
    assert list(operator(dense).values()) == pytest.approx(list(operator(frames).values()), rel=1e-4)
    assert operator(dense)["q_max"] < 0.995 * AMPLITUDE * OMEGA


def test_pressure_observations_have_their_signs_and_units() -> None:
    times = np.arange(400) * PERIOD / 400
    values = 1e3 + 15e3 * np.sin(np.pi * times / PERIOD) ** 2
    observations = PressureFeatures()(Curve.of_pressure(times, values, PERIOD))
    assert observations["P_max"] == pytest.approx(16e3, rel=1e-3)
    assert observations["dPdt_max"] == pytest.approx(15e3 * np.pi / PERIOD, rel=5e-3)
    assert observations["dPdt_min"] == pytest.approx(-15e3 * np.pi / PERIOD, rel=5e-3)
    assert PressureFeatures().units == ("Pa", "Pa/s", "Pa/s")


@pytest.mark.parametrize(("window", "order"), [(4, 2), (3, 3), (27, 2), (3, 0)])
def test_an_invalid_window_is_refused(window: int, order: int) -> None:
    with pytest.raises(ValueError, match="odd"):
        VolumeFeatures(frames=25, window=window, order=order)
