"""Two readings of a curve: the noise of their mean, against samples of known covariance."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.observation.curve import Curve
from heartfit.observation.second_reading import FrameNoise, TwoReadings

FRAMES, PERIOD = 400, 13.3
TIMES = np.arange(FRAMES) * PERIOD / FRAMES
STEP = PERIOD / FRAMES
EVERY, HALF = np.ones(FRAMES, dtype=bool), np.arange(FRAMES) % 2 == 0
TRUE = 100e-6 + 40e-6 * np.cos(2.0 * np.pi * TIMES / PERIOD)


@pytest.mark.parametrize("memory", [0.0, 0.04])
def test_the_noise_of_the_mean_is_recovered(memory: float) -> None:
    rng, noise = np.random.default_rng(3), FrameNoise(2e-6, memory)
    root = np.linalg.cholesky(noise.covariance(TIMES))
    first, second = (Curve(TIMES, TRUE + root @ rng.standard_normal(FRAMES), PERIOD) for _ in range(2))
    readings = TwoReadings(first, second, EVERY)
    estimated = readings.noise()
    assert estimated.deviation == pytest.approx(2e-6 / np.sqrt(2.0), rel=0.12)
    neighbours = [np.exp(-STEP / tau) if tau else 0.0 for tau in (estimated.memory, memory)]
    assert neighbours[0] == pytest.approx(neighbours[1], abs=0.12)
    assert np.std(readings.mean.values - TRUE) == pytest.approx(estimated.deviation, rel=0.15)


def test_one_reading_alone_is_noisier_by_the_root_of_two() -> None:
    first, second = Curve(TIMES, TRUE, PERIOD), Curve(TIMES, TRUE + 1e-6 * np.cos(40.0 * TIMES), PERIOD)
    readings = TwoReadings(first, second, EVERY)
    assert readings.take("mean")[1] == readings.noise()
    for name, curve in (("first", first), ("second", readings.scaled)):
        taken, noise = readings.take(name)
        assert taken is curve
        assert noise.deviation == pytest.approx(np.sqrt(2.0) * readings.noise().deviation)
        assert noise.memory == readings.noise().memory


def test_the_scale_of_the_second_reading_is_that_of_the_first() -> None:
    """Offset and slope are the first's, so a reading in another unit is the same reading."""
    rng = np.random.default_rng(1)
    first, second = (Curve(TIMES, TRUE + 2e-6 * rng.standard_normal(FRAMES), PERIOD) for _ in range(2))
    other = replace(second, values=3.0 * second.values - 20e-6)
    taken, again = (TwoReadings(first, one, EVERY) for one in (second, other))
    assert again.scaled.values == pytest.approx(taken.scaled.values)
    assert again.noise().deviation == pytest.approx(taken.noise().deviation)


def test_frames_that_judge_give_neither_scale_nor_noise() -> None:
    rng = np.random.default_rng(2)
    first, second = (Curve(TIMES, TRUE + 2e-6 * rng.standard_normal(FRAMES), PERIOD) for _ in range(2))
    spoilt = replace(second, values=np.where(HALF, second.values, 0.7 * second.values + 9e-6))
    sound, misread = (TwoReadings(first, one, HALF) for one in (second, spoilt))
    assert misread.noise() == sound.noise()
    assert misread.mean.values[HALF] == pytest.approx(sound.mean.values[HALF])
    assert misread.mean.values[~HALF] != pytest.approx(sound.mean.values[~HALF])


def test_an_error_of_the_length_does_not_show_in_the_difference() -> None:
    """It moves both readings by the same share of the volume: the noise is that of the rest, a lower bound."""
    rng, length = np.random.default_rng(3), 1.0 + 0.02 * np.random.default_rng(4).standard_normal(FRAMES)
    first, second = (TRUE + 1e-6 * rng.standard_normal(FRAMES) for _ in range(2))
    readings = TwoReadings(Curve(TIMES, first * length, PERIOD), Curve(TIMES, second * length, PERIOD), EVERY)
    assert readings.noise().deviation == pytest.approx(1e-6 / np.sqrt(2.0), rel=0.15)
    assert np.std(readings.mean.values - TRUE) > 2.0 * readings.noise().deviation


def test_equal_readings_have_no_noise() -> None:
    curve = Curve(TIMES, TRUE, PERIOD)
    assert TwoReadings(curve, curve, EVERY).noise().deviation < 1e-12 * TRUE.max()


def test_readings_of_other_frames_are_refused() -> None:
    curve = Curve(TIMES, TRUE, PERIOD)
    with pytest.raises(InputError, match="its times differ"):
        TwoReadings(curve, curve.resampled(25), EVERY)
