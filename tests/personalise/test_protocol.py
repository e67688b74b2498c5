"""The steps of a calibration, without the simulations between them."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.calibration.sensitivity import Slopes
from heartfit.calibration.unscented import sigma_points
from heartfit.calibration.update import Posterior
from heartfit.heart.beat import Beat
from heartfit.mechanisms.image_smoothing import ImageSmoothing
from heartfit.observation.beat import beat_curves
from heartfit.observation.measurement import Measurement, Observation, observe_measured
from heartfit.personalise.numerics import Operator, Transform
from heartfit.personalise.run import estimate
from heartfit.personalise.setting import Prior, Setting

PERIOD, TRIGGER, FRAMES = 0.8, 0.18, 25
SENSORS = {"smoothing": 0.02, "delay": 0.01, "shrinkage": 0.1}


def beat() -> Beat:
    time = np.linspace(0.0, PERIOD, 201)
    wave = 2.0 * np.pi * (time - TRIGGER) / PERIOD
    volume = 1e-6 * (105.0 + 38.0 * np.cos(wave) + 12.0 * np.cos(3.0 * wave))
    return Beat(time, {"lv": volume}, {}, {}, PERIOD, TRIGGER)


@pytest.mark.parametrize("smoothing", [0.0135, 0.0165])
def test_a_sigma_point_is_observed_through_the_sensors_of_its_parameters(smoothing: float) -> None:
    """All points have the same beat, so the data inform the sensor only through its effect on each point."""
    setting = Setting(
        element="sphere",
        mechanisms=("ImageSmoothing",),
        estimate=("smoothing",),
        prior={"smoothing": Prior(mean=0.015, sd=0.1)},
    )
    operator = Operator(frames=FRAMES, window=3, order=2, period_uncertainty=0.0)
    measured = {"lv_volume": beat_curves(beat(), [ImageSmoothing(smoothing)])["lv_volume"].resampled(FRAMES)}
    noiseless = observe_measured(measured, operator.features(measured), 0.0).observations
    exact = Measurement.independent(
        [replace(observation, noise=1e-4 * abs(observation.value)) for observation in noiseless]
    )
    points, beats = sigma_points(setting.gaussian()), [beat()] * 3
    arguments = (setting.gaussian(), points, beats, measured, exact, operator, Transform(noise=True))
    estimated_smoothing = estimate(setting, *arguments).estimate.physical()["smoothing"]
    assert estimated_smoothing == pytest.approx(smoothing, rel=0.01)  # by one linear step from 15 ms


def estimated(measurement: Measurement, noise: bool, slopes: Slopes | None = None) -> Posterior:
    """Posterior of three sensors; each point has the same beat."""
    prior = {name: Prior(mean=mean, sd=0.3) for name, mean in SENSORS.items()}
    setting = Setting(
        element="sphere",
        mechanisms=("ImageSmoothing", "ImageTriggerDelay", "ImageShrinkage"),
        estimate=tuple(prior),
        prior=prior,
    )
    operator = Operator(frames=FRAMES, window=3, order=2, period_uncertainty=0.0)
    measured = {"lv_volume": beat_curves(beat())["lv_volume"].resampled(FRAMES)}
    points = sigma_points(setting.gaussian())
    arguments = points, [beat()] * len(points), measured, measurement, operator
    transform = Transform().with_noise() if noise else Transform()
    return estimate(setting, setting.gaussian(), *arguments, transform, slopes)


OBSERVATIONS = [
    Observation("V_min", 6.0e-5, "m^3", 2e-6, 3e-6),
    Observation("q_max", 4.5e-4, "m^3/s", 3e-5, -4e-5),
    Observation("q_min", -4.2e-4, "m^3/s", 2e-5, 2e-5),
]


def test_noise_subtracts_the_bias_and_weighs_by_the_covariance_unlike_the_paper() -> None:
    independent = Measurement.independent(OBSERVATIONS)
    sd = np.array([observation.noise for observation in OBSERVATIONS])
    correlation = np.array([[1.0, -0.3, 0.2], [-0.3, 1.0, -0.8], [0.2, -0.8, 1.0]])
    together = Measurement(OBSERVATIONS, correlation * np.outer(sd, sd))
    paper = estimated(independent, noise=False)
    assert paper.observed.tolist() == [6.0e-5, 4.5e-4, -4.2e-4]
    assert np.array_equal(estimated(together, noise=False).estimate.mean, paper.estimate.mean)
    posterior = estimated(together, noise=True)
    assert posterior.observed == pytest.approx([5.7e-5, 4.9e-4, -4.4e-4])
    total = posterior.cov_zz + together.covariance
    expected = posterior.cov_xz @ np.linalg.solve(total, posterior.observed - posterior.predicted)
    assert posterior.estimate.mean - posterior.prior.mean == pytest.approx(expected)
    assert estimated(independent, noise=True).estimate.mean != pytest.approx(
        posterior.estimate.mean, rel=1e-3
    )


def test_fixed_parameters_add_noise_only_where_noise_is_known() -> None:
    independent = Measurement.independent(OBSERVATIONS)
    slopes = Slopes(
        ("sigma_0", "delay"), ("V_min", "q_max", "q_min"), np.array([[0.5, 0.2, -0.3], [9.0, 9.0, 9.0]])
    )
    posterior = estimated(independent, True, slopes)
    offset = 0.1 * np.array([0.5, 0.2, -0.3]) * posterior.observed
    total = posterior.cov_zz + independent.covariance + np.outer(offset, offset)
    expected = posterior.cov_xz @ np.linalg.solve(total, posterior.observed - posterior.predicted)
    assert posterior.estimate.mean - posterior.prior.mean == pytest.approx(expected), (
        "delay is estimated, so not fixed"
    )
    noise_free, plain = estimated(independent, False, slopes), estimated(independent, False)
    assert np.array_equal(noise_free.estimate.mean, plain.estimate.mean)
