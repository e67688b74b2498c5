"""Motions that cannot be are refused, and say which phase is wrong."""

import numpy as np
import pytest

from heartfit.errors import InputError
from heartfit.geometry.motion import Motion

TIMES = np.linspace(0.0, 0.9, 10)
POSITIONS = np.zeros((10, 4, 3))


def test_a_motion_within_one_period_is_taken() -> None:
    assert Motion(TIMES, 1.0, POSITIONS).period == 1.0


@pytest.mark.parametrize(
    ("times", "period", "positions", "what"),
    [
        (TIMES[:7], 1.0, POSITIONS[:7], "7 phases; expected at least 8"),
        (np.array([0.0, 0.1, 0.2, 0.3, 0.1, *TIMES[5:]]), 1.0, POSITIONS, "phase 4 is at 0.1 s"),
        (TIMES, 0.9, POSITIONS, "within"),
        (TIMES, 1.0, POSITIONS[:9], "expected \\(10, nodes, 3\\)"),
        (TIMES, 1.0, np.full_like(POSITIONS, np.nan), "NaN"),
    ],
)
def test_a_motion_that_cannot_be_is_refused(
    times: np.ndarray, period: float, positions: np.ndarray, what: str
) -> None:
    with pytest.raises(InputError, match=what):
        Motion(times, period, positions)
