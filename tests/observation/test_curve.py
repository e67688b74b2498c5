"""A curve is periodic and refuses values that would give a silent wrong result."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.observation.curve import Curve

TIMES = np.arange(25) * 0.033
VOLUME = 120e-6 + 50e-6 * np.cos(2 * np.pi * TIMES / 0.825) + 10e-6 * np.sin(4 * np.pi * TIMES / 0.825)


def test_is_periodic_and_shifts_its_zero() -> None:
    curve = Curve.of_volume(TIMES, VOLUME, 0.825)
    assert curve(np.array([0.825 + TIMES[3]])) == pytest.approx(VOLUME[3])
    assert curve.shifted(0.033)(np.array([0.0])) == pytest.approx(VOLUME[1])


def test_resampling_at_the_original_frames_changes_no_value() -> None:
    assert Curve(TIMES, VOLUME, 0.825).resampled(25).values == pytest.approx(VOLUME, rel=1e-12)


@pytest.mark.parametrize(
    ("times", "values", "period", "message"),
    [
        (TIMES[:7], VOLUME[:7], 0.825, r"\b7\b.*\b8\b"),
        (TIMES[::-1], VOLUME, 0.825, "sort the samples"),
        (TIMES, np.where(TIMES[4] == TIMES, np.nan, VOLUME), 0.825, r"values\[4\] = nan"),
        (TIMES, VOLUME, TIMES[-1], "repeats the first"),
        (TIMES, VOLUME, -1.0, "period = -1.0 s"),
        (TIMES, VOLUME[1:], 0.825, "one value for each time"),
    ],
)
def test_bad_samples_are_named(times: np.ndarray, values: np.ndarray, period: float, message: str) -> None:
    with pytest.raises(InputError, match=message):
        Curve(times, values, period)


def test_millilitres_are_not_cubic_metres() -> None:
    with pytest.raises(InputError, match="mL"):
        Curve.of_volume(TIMES, VOLUME * 1e6, 0.825)


@pytest.mark.parametrize(
    ("peak", "hint"), [(16.0, "kPa or mmHg"), (120e3, "mmHg.*kPa"), (-1e6, "check the numbers")]
)
def test_impossible_pressures_are_named(peak: float, hint: str) -> None:
    with pytest.raises(InputError, match=hint):
        Curve.of_pressure(TIMES, peak * np.sin(np.pi * TIMES / 0.825) ** 2, 0.825)
