"""The observation vector from measured curves and from beats, simulated and failed."""

import numpy as np
import pytest

from heartfit.beat import Beat, failed_beat
from heartfit.observation.beat import beat_curves, observe_beats
from heartfit.observation.curve import Curve
from heartfit.observation.vector import cavity_indices, observe, observe_measured, operators

PERIOD, TRIGGER = 0.8, 0.18


def beat() -> Beat:
    """End diastole at the trigger; the last sample repeats the first."""
    time = np.linspace(0, PERIOD, 401)
    wave = np.cos(2 * np.pi * (time - TRIGGER) / PERIOD)
    volumes = {"lv": 120e-6 + 50e-6 * wave, "rv": 110e-6 + 40e-6 * wave}
    return Beat(time, volumes, {"lv": 8e3 - 7e3 * wave}, {"mitral": 1e-4 * wave}, PERIOD, TRIGGER)


def measured(frames: int = 25) -> dict[str, Curve]:
    times = np.arange(frames) * PERIOD / frames
    return {"lv_volume": Curve(times, 120e-6 + 50e-6 * np.cos(2 * np.pi * times / PERIOD), PERIOD)}


def test_a_beat_and_its_own_frames_are_observed_alike() -> None:
    features = operators(measured())
    assert features["lv_volume"].frames == 25
    found = observe(beat_curves(beat()), features)
    assert found == pytest.approx(observe(measured(), features), rel=1e-3)


def test_pressure_is_observed_where_it_was_measured() -> None:
    curves = measured() | {"lv_pressure": beat_curves(beat())["lv_pressure"]}
    found = observe(curves, operators(curves))
    assert list(found) == ["V_min", "q_max", "q_min", "P_max", "dPdt_max", "dPdt_min"]
    noisy = observe_measured(curves, operators(curves))
    assert [o.unit for o in noisy] == ["m^3", "m^3/s", "m^3/s", "Pa", "Pa/s", "Pa/s"]
    assert [o.value for o in noisy] == list(found.values())


def test_time_zero_is_the_trigger() -> None:
    curves = beat_curves(beat())
    assert set(curves) == {"lv_volume", "rv_volume", "lv_pressure", "mitral_flow"}
    assert curves["lv_volume"](0.0) == pytest.approx(170e-6)
    indices = cavity_indices(curves, "rv")
    assert indices["EDV"] == pytest.approx(150e-6)
    assert indices["ESV"] == pytest.approx(70e-6)
    assert indices["EF"] == pytest.approx(80 / 150)


def test_a_failed_beat_is_its_reason_and_has_no_curves() -> None:
    failed = failed_beat("inverted", PERIOD, TRIGGER, {})
    assert observe_beats([beat(), failed], operators(measured()))[1] == "inverted"
    with pytest.raises(ValueError, match="no curve lv_volume; there are none: did the beat fail"):
        observe(beat_curves(failed), operators(measured()))
