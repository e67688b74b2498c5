"""The observation vector from measured curves and from beats, simulated and failed."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.heart.beat import Beat, failed_beat
from heartfit.observation.beat import beat_curves, observe_beats
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import observe_measured
from heartfit.observation.noise_model import NoiseModel
from heartfit.observation.operator import cavity_indices, observe, operators
from heartfit.observation.scatter import Scatter

PERIOD, TRIGGER = 0.8, 0.18
BIAS = np.array([0.05, -0.2, -0.1])
SPREAD = np.array([[2.0, -1.0, -1.0], [-1.0, 8.0, 4.0], [-1.0, 4.0, 6.0]]) * 1e-3
MODEL = NoiseModel(
    {},
    Scatter(("V_min", "q_max", "q_min"), 24, BIAS, SPREAD),
    {"lv_volume": Scatter(("0",), 24, np.zeros(1), np.eye(1))},
)


def beat() -> Beat:
    """End diastole at the trigger; the last sample repeats the first."""
    time = np.linspace(0, PERIOD, 401)
    wave = np.cos(2 * np.pi * (time - TRIGGER) / PERIOD)
    volumes = {"lv": 120e-6 + 50e-6 * wave, "rv": 110e-6 + 40e-6 * wave}
    return Beat(time, volumes, {"lv": 8e3 - 7e3 * wave}, {"mitral": 1e-4 * wave}, PERIOD, TRIGGER)


def measured(frames: int = 25) -> dict[str, Curve]:
    times = np.arange(frames) * PERIOD / frames
    return {"lv_volume": Curve(times, 120e-6 + 50e-6 * np.cos(2 * np.pi * times / PERIOD), PERIOD)}


@pytest.mark.parametrize("frames", [25, 36])
def test_a_beat_and_its_frames_have_the_same_observations(frames: int) -> None:
    features = operators(measured(frames))
    assert features["lv_volume"].frames == frames
    observed = observe(beat_curves(beat()), features)
    assert observed == pytest.approx(observe(measured(frames), features), rel=1e-3)


def test_pressure_is_observed_where_it_was_measured() -> None:
    curves = measured() | {"lv_pressure": beat_curves(beat())["lv_pressure"]}
    observed = observe(curves, operators(curves))
    assert list(observed) == ["V_min", "q_max", "q_min", "P_max", "dPdt_max", "dPdt_min"]
    noisy = observe_measured(curves, operators(curves))
    assert [o.unit for o in noisy.observations] == ["m^3", "m^3/s", "m^3/s", "Pa", "Pa/s", "Pa/s"]
    assert noisy.values == noisy.corrected == observed
    assert np.array_equal(noisy.covariance, np.diag([o.noise**2 for o in noisy.observations]))


def test_a_noise_model_gives_bias_and_covariance() -> None:
    features = operators(measured())
    observed = observe_measured(measured(), features, 0.0, MODEL)
    assert observed.values == observe(measured(), features)
    stroke = np.ptp(measured()["lv_volume"].values)
    v_min, q_max, q_min = observed.values.values()
    truths = [v_min - stroke * BIAS[0], q_max * np.exp(-BIAS[1]), q_min * np.exp(-BIAS[2])]
    assert list(observed.corrected.values()) == pytest.approx(truths)
    sizes = np.array([stroke, *truths[1:]])
    assert observed.covariance == pytest.approx(np.outer(sizes, sizes) * SPREAD * 25 / 24, rel=1e-12, abs=0.0)
    assert [o.noise**2 for o in observed.observations] == pytest.approx(
        np.diag(observed.covariance), rel=1e-12, abs=0.0
    )


def test_an_uncertain_period_adds_what_a_stretched_curve_shows() -> None:
    features = operators(measured())
    plain, uncertain = (observe_measured(measured(), features, p, MODEL) for p in (0.0, 0.05))
    curve = measured()["lv_volume"]
    longer, shorter = (
        np.array(list(observe({"lv_volume": stretched}, features).values()))
        for stretched in (replace(curve, times=curve.times * s, period=PERIOD * s) for s in (1.0001, 0.9999))
    )
    slope = np.exp(-BIAS) * (longer - shorter) / 2e-4
    added = uncertain.covariance - plain.covariance
    assert added == pytest.approx(0.05**2 * np.outer(slope, slope), rel=1e-6, abs=1e-22)
    assert uncertain.corrected == plain.corrected


def test_a_noise_model_refuses_unknown_observations() -> None:
    curves = measured() | {"lv_pressure": beat_curves(beat())["lv_pressure"]}
    with pytest.raises(InputError, match="P_max, dPdt_max, dPdt_min"):
        observe_measured(curves, operators(curves), noise_model=MODEL)


def test_time_zero_is_the_trigger() -> None:
    curves = beat_curves(beat())
    assert set(curves) == {"lv_volume", "rv_volume", "lv_pressure", "mitral_flow"}
    assert curves["lv_volume"](0.0) == pytest.approx(170e-6)
    indices = cavity_indices(curves, "rv")
    assert indices["EDV"] == pytest.approx(150e-6)
    assert indices["ESV"] == pytest.approx(70e-6)
    assert indices["EF"] == pytest.approx(80 / 150)


def test_a_failed_beat_has_a_reason_and_no_curves() -> None:
    failed = failed_beat("inverted", PERIOD, TRIGGER, {})
    assert observe_beats([beat(), failed], operators(measured()))[1] == "inverted"
    with pytest.raises(ValueError, match="curve lv_volume"):
        observe(beat_curves(failed), operators(measured()))
