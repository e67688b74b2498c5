"""Figures show every existing curve and tolerate missing ones."""

import numpy as np
import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.calibration.unscented import sigma_points
from heartfit.calibration.update import calibrate
from heartfit.observation.curve import Curve
from heartfit.observation.operator import VolumeFeatures
from heartfit.results.colours import SETTING_COLOURS
from heartfit.results.figures import MEASURED, REFERENCE, plot_case, plot_sensitivity

PERIOD = 0.8


def ventricles(samples: int, late: float = 0.0) -> dict[str, Curve]:
    times = np.arange(samples) * PERIOD / samples
    wave = np.cos(2 * np.pi * (times - late) / PERIOD)
    return {
        "lv_volume": Curve(times, 120e-6 + 50e-6 * wave, PERIOD),
        "rv_volume": Curve(times, 110e-6 + 45e-6 * wave, PERIOD),
        "lv_pressure": Curve(times, 8e3 - 7e3 * wave, PERIOD),
        "aorta_pressure": Curve(times, 12e3 - 2e3 * wave, PERIOD),
    }


def test_volumes_and_the_shift_are_drawn() -> None:
    measured = {name: curve for name, curve in ventricles(25).items() if "volume" in name}
    curves = {"measured": measured, "reference": ventricles(200), "calibrated": ventricles(200, late=0.05)}
    figure = plot_case(curves, "volunteer, physical", VolumeFeatures(), SETTING_COLOURS[1], shift=0.05)
    lines = figure.axes[0].get_lines()
    assert [line.get_label() for line in lines] == ["measured", "reference", "calibrated"]
    time, volume = lines[2].get_data()
    assert (np.diff(time) > 0).all()
    assert time.min() >= 0
    assert abs(time[np.argmin(volume)] - PERIOD / 2) < 0.01
    assert "volunteer, physical" in figure.get_suptitle()
    assert [line.get_color() for line in lines] == [MEASURED, REFERENCE, SETTING_COLOURS[1]]
    pressures = figure.axes[2].get_lines()
    assert {line.get_color() for line in pressures if line.get_label() in ("artery", "calibrated")} == {
        SETTING_COLOURS[1]
    }


def test_a_failed_beat_is_left_out() -> None:
    figure = plot_case(
        {"measured": ventricles(25), "reference": {}}, "t", VolumeFeatures(), SETTING_COLOURS[0]
    )
    assert len(figure.axes[0].get_lines()) == 1


def test_sensitivities_are_bars_of_every_parameter_and_observation() -> None:
    prior = Gaussian.from_relative({"sigma_0": 240e3, "mu": 7e3}, {"sigma_0": 0.2, "mu": 0.3})
    outcomes = [{"V_min": 80 - 20 * point.z[0], "q_max": 400 + point.z[1]} for point in sigma_points(prior)]
    posterior = calibrate(prior, outcomes, outcomes[0])
    bars = plot_sensitivity(posterior, "real").axes[0].patches
    assert [bar.get_height() for bar in bars] == pytest.approx([-1, 0, 0, 1], abs=1e-6)
