"""A volume curve of another heart rate: systole keeps its length, the period is the one that is stated."""

import numpy as np
import pytest

from heartfit.mechanisms.rate_mismatch import RateMismatch

PERIOD, SYSTOLE = 0.8, 0.32
TIMES = np.arange(1600) * PERIOD / 1600 - 0.17


def volume(times: np.ndarray) -> np.ndarray:
    wave = 2.0 * np.pi * times / PERIOD
    return 90e-6 + 40e-6 * np.cos(wave) + 5e-6 * np.sin(2.0 * wave)


@pytest.mark.parametrize("stretch", [0.25, -0.2])
def test_a_longer_beat_is_shown_over_the_stated_period(stretch: float) -> None:
    """Curve of the breath-hold, sampled over its own period, shown over the stated one."""
    shown = RateMismatch(stretch, SYSTOLE).distort(TIMES, volume(TIMES), PERIOD)
    longer = SYSTOLE + (1.0 + stretch) * (PERIOD - SYSTOLE)
    for time in (0.0, 0.1, 0.3, 0.31, 0.5, 0.62):
        breath_hold = time * longer / PERIOD
        beyond = max(breath_hold - SYSTOLE, 0.0)
        true = min(breath_hold, SYSTOLE) + beyond / (1.0 + stretch)
        at_time = np.interp(time, TIMES, shown, period=PERIOD)
        assert at_time == pytest.approx(volume(np.array(true)), abs=1e-9)


def test_the_shown_curve_closes_and_keeps_its_extremes() -> None:
    shown = RateMismatch(0.2, SYSTOLE).distort(TIMES, volume(TIMES), PERIOD)
    steps = np.diff(shown, append=shown[0])
    assert abs(steps).max() < 1.5 * abs(np.diff(volume(TIMES))).max()
    assert [shown.min(), shown.max()] == pytest.approx([volume(TIMES).min(), volume(TIMES).max()], rel=1e-4)


def test_a_systole_that_fills_the_beat_is_refused() -> None:
    with pytest.raises(ValueError, match=r"RateMismatch\.systole = 0\.9 s.*0\.8 s"):
        RateMismatch(0.1, 0.9).distort(TIMES, volume(TIMES), PERIOD)
