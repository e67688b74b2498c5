"""The steps of a calibration, without the simulations between them."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.beat import Beat
from heartfit.calibration.unscented import sigma_points
from heartfit.configuration.setting import Prior, Setting
from heartfit.configuration.study import Operator, Transform
from heartfit.mechanisms.image_smoothing import ImageSmoothing
from heartfit.observation.beat import beat_curves
from heartfit.observation.vector import observe_measured
from heartfit.protocol import estimate

PERIOD, TRIGGER, FRAMES = 0.8, 0.18, 25


def beat() -> Beat:
    time = np.linspace(0.0, PERIOD, 201)
    wave = 2.0 * np.pi * (time - TRIGGER) / PERIOD
    volume = 1e-6 * (105.0 + 38.0 * np.cos(wave) + 12.0 * np.cos(3.0 * wave))
    return Beat(time, {"lv": volume}, {}, {}, PERIOD, TRIGGER)


@pytest.mark.parametrize("smoothing", [0.0135, 0.0165])
def test_a_sigma_point_is_seen_through_the_sensors_of_its_own_parameters(smoothing: float) -> None:
    """All points have the same beat, so all that is known of the sensor comes from what it shows of each."""
    setting = Setting(
        element="sphere",
        mechanisms=("ImageSmoothing",),
        estimate=("smoothing",),
        prior={"smoothing": Prior(mean=0.015, sd=0.1)},
    )
    operator = Operator(frames=FRAMES, window=3, order=2, period_uncertainty=0.0)
    measured = {"lv_volume": beat_curves(beat(), [ImageSmoothing(smoothing)])["lv_volume"].resampled(FRAMES)}
    noiseless = observe_measured(measured, operator.features(measured), 0.0)
    observations = [replace(each, noise=1e-4 * abs(each.value)) for each in noiseless]
    points, beats = sigma_points(setting.gaussian()), [beat()] * 3
    given = (setting.gaussian(), points, beats, measured, observations, operator, Transform(noise=True))
    found = estimate(setting, *given).estimate.physical()["smoothing"]
    assert found == pytest.approx(smoothing, rel=0.01)  # by one linear step from 15 ms
