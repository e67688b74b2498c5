"""Two readings of a curve: the noise of their mean, against samples of known covariance."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.observation.curve import Curve
from heartfit.observation.second_reading import FrameNoise, TwoReadings

FRAMES, PERIOD = 400, 13.3
TIMES = np.arange(FRAMES) * PERIOD / FRAMES
STEP = PERIOD / FRAMES
TRUE = 100e-6 + 40e-6 * np.cos(2.0 * np.pi * TIMES / PERIOD)


@pytest.mark.parametrize("memory", [0.0, 0.04])
def test_the_noise_of_the_mean_is_recovered(memory: float) -> None:
    rng, noise = np.random.default_rng(3), FrameNoise(2e-6, memory)
    root = np.linalg.cholesky(noise.covariance(TIMES))
    first, second = (Curve(TIMES, TRUE + root @ rng.standard_normal(FRAMES), PERIOD) for _ in range(2))
    readings = TwoReadings(first, second)
    estimated = readings.noise()
    assert estimated.deviation == pytest.approx(2e-6 / np.sqrt(2.0), rel=0.12)
    neighbours = [np.exp(-STEP / tau) if tau else 0.0 for tau in (estimated.memory, memory)]
    assert neighbours[0] == pytest.approx(neighbours[1], abs=0.12)
    assert np.std(readings.mean.values - TRUE) == pytest.approx(estimated.deviation, rel=0.15)


def test_one_reading_alone_is_noisier_by_the_root_of_two() -> None:
    first, second = Curve(TIMES, TRUE, PERIOD), Curve(TIMES, TRUE + 1e-6 * np.cos(40.0 * TIMES), PERIOD)
    readings = TwoReadings(first, second)
    assert readings.take("mean")[1] == readings.noise()
    for name, curve in (("first", first), ("second", second)):
        taken, noise = readings.take(name)
        assert taken is curve
        assert noise.deviation == pytest.approx(np.sqrt(2.0) * readings.noise().deviation)
        assert noise.memory == readings.noise().memory


def test_equal_readings_have_no_noise() -> None:
    curve = Curve(TIMES, TRUE, PERIOD)
    assert TwoReadings(curve, curve).noise() == FrameNoise(0.0, 0.0)


def test_readings_of_other_frames_are_refused() -> None:
    curve = Curve(TIMES, TRUE, PERIOD)
    with pytest.raises(InputError, match="its times differ"):
        TwoReadings(curve, curve.resampled(25))
