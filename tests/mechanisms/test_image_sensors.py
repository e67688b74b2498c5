"""Image sensors against closed forms."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.mechanisms.image_shrinkage import ImageShrinkage
from heartfit.mechanisms.image_smoothing import ImageSmoothing
from heartfit.mechanisms.image_trigger_delay import ImageTriggerDelay

PERIOD, COUNT = 0.8, 160
TIMES = np.arange(COUNT) * PERIOD / COUNT - 0.17


def harmonics(times: np.ndarray) -> np.ndarray:
    """A curve of few harmonics: mean 110 mL, the first, third and seventh."""
    wave = 2.0 * np.pi * times / PERIOD
    return 1e-6 * (110.0 + 35.0 * np.cos(wave - 0.3) + 12.0 * np.sin(3.0 * wave) + 4.0 * np.cos(7.0 * wave))


@pytest.mark.parametrize("shrinkage", [0.25, -0.1])
def test_shrinkage_scales_every_excursion_from_the_trigger_frame(shrinkage: float) -> None:
    times = np.arange(COUNT) * PERIOD / COUNT - 34 * PERIOD / COUNT  # sample 34 is the trigger
    values = harmonics(times)
    shown = ImageShrinkage(shrinkage).distort(times, values, PERIOD)
    assert shown - shown[34] == pytest.approx((1.0 - shrinkage) * (values - values[34]), rel=1e-12, abs=1e-18)
    assert shown[34] == values[34]
    assert np.ptp(shown) == pytest.approx((1.0 - shrinkage) * np.ptp(values))


def test_shrinkage_leaves_some_motion() -> None:
    with pytest.raises(InputError, match=r"ImageShrinkage\.shrinkage = 1\b"):
        ImageShrinkage(1.0)


@pytest.mark.parametrize("k", [1, 3, 7, 20])
def test_smoothing_attenuates_each_harmonic_as_a_gaussian_window_does(k: int) -> None:
    tau, wave = 0.02, np.cos(2.0 * np.pi * k * TIMES / PERIOD + 0.4)
    shown = ImageSmoothing(tau).distort(TIMES, wave, PERIOD)
    assert shown == pytest.approx(np.exp(-0.5 * (2.0 * np.pi * k * tau / PERIOD) ** 2) * wave, abs=1e-14)


def test_smoothing_is_the_average_over_a_gaussian_window() -> None:
    """By quadrature of the convolution itself."""
    tau, u = 0.03, np.linspace(-0.3, 0.3, 6001)
    window = np.exp(-0.5 * (u / tau) ** 2) / (np.sqrt(2.0 * np.pi) * tau)
    averaged = np.trapezoid(window * harmonics(TIMES[:, None] - u), u, axis=1)
    assert ImageSmoothing(tau).distort(TIMES, harmonics(TIMES), PERIOD) == pytest.approx(averaged, rel=1e-9)


def test_smoothing_keeps_the_mean_volume_and_adds_up_in_variance() -> None:
    values = harmonics(TIMES) + 1e-6 * np.random.default_rng(0).standard_normal(COUNT)
    twice = ImageSmoothing(0.03).distort(TIMES, ImageSmoothing(0.04).distort(TIMES, values, PERIOD), PERIOD)
    assert twice == pytest.approx(ImageSmoothing(0.05).distort(TIMES, values, PERIOD), rel=1e-12)
    assert twice.mean() == pytest.approx(values.mean(), rel=1e-13)


@pytest.mark.parametrize("delay", [0.0217, -0.1, 0.3])
def test_a_delayed_curve_is_the_curve_of_earlier_times(delay: float) -> None:
    shown = ImageTriggerDelay(delay).distort(TIMES, harmonics(TIMES), PERIOD)
    assert shown == pytest.approx(harmonics(TIMES - delay), rel=1e-12)


def test_a_delay_of_whole_samples_shifts_a_curve_exactly() -> None:
    values = np.random.default_rng(1).standard_normal(COUNT)
    shown = ImageTriggerDelay(8 * PERIOD / COUNT).distort(TIMES, values, PERIOD)
    assert shown == pytest.approx(np.roll(values, 8), abs=1e-12)


def test_a_filter_needs_equidistant_samples_of_a_whole_period() -> None:
    skewed = TIMES + 1e-3 * np.linspace(0.0, 1.0, COUNT) ** 2
    for times in (skewed, 0.9 * TIMES):
        with pytest.raises(InputError, match="equidistant"):
            ImageSmoothing(0.02).distort(times, harmonics(times), PERIOD)
