"""Motions: impossible ones are refused with the wrong phase, others are periodic and linear between phases."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.mesh import Motion

TIMES = np.linspace(0.0, 0.9, 10)
POSITIONS = np.zeros((10, 4, 3))


def test_a_motion_within_one_period_is_taken() -> None:
    assert Motion(TIMES, 1.0, POSITIONS).period == 1.0


@pytest.mark.parametrize(
    ("times", "period", "positions", "message"),
    [
        (TIMES[:7], 1.0, POSITIONS[:7], r"\b7\b.*\b8\b"),
        (np.array([0.0, 0.1, 0.2, 0.3, 0.1, *TIMES[5:]]), 1.0, POSITIONS, r"phase 4\b.*\b0\.1 s"),
        (TIMES, 0.9, POSITIONS, "within"),
        (TIMES, 1.0, POSITIONS[:9], r"\(10, nodes, 3\)"),
        (TIMES, 1.0, np.full_like(POSITIONS, np.nan), "NaN"),
    ],
)
def test_an_invalid_motion_is_refused(
    times: np.ndarray, period: float, positions: np.ndarray, message: str
) -> None:
    with pytest.raises(InputError, match=message):
        Motion(times, period, positions)


def test_between_phases_a_motion_is_linear_and_it_repeats_itself() -> None:
    """Includes the interval from the last phase to the next beat, and a first phase after time zero."""
    rng = np.random.default_rng(0)
    positions = rng.random((10, 4, 3))
    motion = Motion(TIMES + 0.05, 1.0, positions)
    assert motion.at(0.25) == pytest.approx(positions[2])
    assert motion.at(0.275) == pytest.approx(0.75 * positions[2] + 0.25 * positions[3])
    assert motion.at(0.975) == pytest.approx(0.75 * positions[9] + 0.25 * positions[0])
    assert motion.at(0.025) == pytest.approx(0.25 * positions[9] + 0.75 * positions[0])
    for beat in (-2.0, -1.0, 3.0):
        assert motion.at(beat + 0.31) == pytest.approx(motion.at(0.31))
