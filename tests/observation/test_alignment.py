"""A planted shift is recovered with its sign."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as some

from heartfit.observation.curve import Curve, fit_shift, root_mean_square

PERIOD = 0.8


def beat(samples: int, late: float = 0.0) -> Curve:
    times = np.arange(samples) * PERIOD / samples
    phase = 2 * np.pi * (times - late) / PERIOD
    return Curve(times, 120e-6 + 40e-6 * np.cos(phase) + 15e-6 * np.sin(2 * phase), PERIOD)


@given(late=some.floats(-0.39, 0.39))
def test_planted_shift_is_recovered(late: float) -> None:
    shift = fit_shift(beat(25), beat(800, late))
    assert shift == pytest.approx(late, abs=2e-4)


def test_the_shift_stays_within_its_limit() -> None:
    assert fit_shift(beat(25), beat(800, 0.2), limit=0.05) == pytest.approx(0.05, abs=1e-3)


def test_root_mean_square_of_a_constant_offset() -> None:
    curve = beat(25)
    other = Curve(curve.times, curve.values + 3e-6, PERIOD)
    assert root_mean_square(curve, other) == pytest.approx(3e-6)


def test_different_heart_rates_are_refused() -> None:
    slow = Curve(np.arange(25) * 0.04, beat(25).values, 1.0)
    with pytest.raises(ValueError, match="same heart rate"):
        fit_shift(beat(25), slow)
