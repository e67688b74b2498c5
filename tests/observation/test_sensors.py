"""Sensors between beats and observations, and the fit that finds them."""

import numpy as np
import pytest

from heartfit.heart.beat import Beat, failed_beat
from heartfit.mechanisms.image_shrinkage import ImageShrinkage
from heartfit.mechanisms.image_smoothing import ImageSmoothing
from heartfit.mechanisms.image_trigger_delay import ImageTriggerDelay
from heartfit.observation.beat import apply_sensors, beat_curves, fit_sensors, observe_beats
from heartfit.observation.curve import Curve
from heartfit.observation.operator import operators
from heartfit.roles import Sensor

PERIOD, TRIGGER = 0.8, 0.18


def volume(times: np.ndarray) -> np.ndarray:
    """End diastole at time zero, ejection faster than filling, m^3."""
    wave = 2.0 * np.pi * times / PERIOD
    return 1e-6 * (
        105.0 + 38.0 * np.cos(wave) + 9.0 * np.cos(2.0 * wave - 0.8) + 3.0 * np.cos(4.0 * wave + 0.5)
    )


def beat() -> Beat:
    time = np.linspace(0.0, PERIOD, 201)
    volumes = {side: volume(time - TRIGGER) for side in ("lv", "rv")}
    return Beat(time, volumes, {"lv": 1e8 * volumes["lv"]}, {"mitral": volumes["lv"]}, PERIOD, TRIGGER)


TRUE = beat_curves(beat())["lv_volume"]
FRAMES = Curve(np.arange(25) * PERIOD / 25, volume(np.arange(25) * PERIOD / 25), PERIOD)


def planted(curve: Curve, parameters: dict[str, float]) -> Curve:
    """Scanner first, then registration."""
    scanner = ImageSmoothing(parameters["smoothing"]), ImageTriggerDelay(parameters["delay"])
    registration = ImageShrinkage(parameters["shrinkage"])
    return apply_sensors({"lv_volume": curve}, (*scanner, registration))["lv_volume"]


def test_a_sensor_acts_only_on_its_curves() -> None:
    plain, distorted = beat_curves(beat()), beat_curves(beat(), [ImageShrinkage(0.2)])
    changed = {name for name in plain if not (plain[name].values == distorted[name].values).all()}
    assert changed == {"lv_volume", "rv_volume"}
    assert np.ptp(distorted["lv_volume"].values) == pytest.approx(0.8 * np.ptp(plain["lv_volume"].values))


def test_time_zero_of_a_sensor_is_the_trigger() -> None:
    distorted = beat_curves(beat(), [ImageShrinkage(0.2)])["lv_volume"]
    assert distorted(0.0) == pytest.approx(volume(np.zeros(1))[0], rel=1e-9)


def test_sensors_act_one_after_the_other() -> None:
    late, small = ImageTriggerDelay(0.1), ImageShrinkage(0.3)
    scanner_first = beat_curves(beat(), [late, small])["lv_volume"]
    assert scanner_first(0.0) == pytest.approx(volume(np.array([-0.1]))[0], rel=1e-9)
    other = beat_curves(beat(), [small, late])["lv_volume"]
    assert other(0.1) == pytest.approx(volume(np.zeros(1))[0], rel=1e-9)


def test_each_beat_is_observed_through_its_own_sensors() -> None:
    features = operators({"lv_volume": FRAMES})
    own: list[tuple[Sensor, ...]] = [(), (ImageShrinkage(0.5),), ()]
    plain, shrunk, reason = observe_beats(
        [beat(), beat(), failed_beat("torn", PERIOD, TRIGGER, {})], features, own
    )
    assert not isinstance(plain, str)
    assert not isinstance(shrunk, str)
    assert shrunk["q_min"] == pytest.approx(0.5 * plain["q_min"])
    assert plain == observe_beats([beat()], features)[0]
    assert reason == "torn"


@pytest.mark.parametrize(
    "parameters",
    [
        {"shrinkage": 0.12, "smoothing": 0.025, "delay": 0.018},
        {"shrinkage": -0.07, "smoothing": 0.012, "delay": -0.17},
        {"shrinkage": 0.4, "smoothing": 0.05, "delay": 0.06},
    ],
)
@pytest.mark.parametrize("true", [TRUE, FRAMES], ids=["fine", "frames"])
def test_planted_sensors_are_recovered(true: Curve, parameters: dict[str, float]) -> None:
    assert fit_sensors(true, planted(true, parameters)) == pytest.approx(parameters, rel=1e-3, abs=1e-6)


def test_without_distortion_the_sensors_are_zero() -> None:
    sensors = fit_sensors(TRUE, TRUE)
    assert sensors == pytest.approx({"shrinkage": 0.0, "smoothing": 0.0, "delay": 0.0}, abs=1e-3)


def test_noise_scatters_the_estimates_about_the_truth() -> None:
    """The mean of 60 fits to frames with 1 mL of noise lies within three standard errors of what was planted."""
    parameters = {"shrinkage": 0.15, "smoothing": 0.03, "delay": 0.02}
    clean, random = planted(FRAMES, parameters), np.random.default_rng(3)
    fits = [
        fit_sensors(FRAMES, Curve(clean.times, clean.values + 1e-6 * random.standard_normal(25), PERIOD))
        for _ in range(60)
    ]
    for name, value in parameters.items():
        estimates = np.array([fit[name] for fit in fits])
        assert abs(estimates.mean() - value) < 3.0 * estimates.std() / np.sqrt(len(fits)), name
        assert estimates.std() < 0.1 * max(value, 0.1), name


def test_curves_of_different_periods_have_no_common_sensor() -> None:
    with pytest.raises(ValueError, match=r"0\.8 s.*1 s"):
        fit_sensors(TRUE, Curve(np.arange(25) / 25, FRAMES.values, 1.0))
