"""A simulated motion is kept in the frames of the measurement, time zero at the trigger, and a failure is kept too."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.heart.beat import Beat, failed_beat
from heartfit.io.meshes import read_simulated_motion, write_simulated_motion

PERIOD, TRIGGER, STEPS = 0.8, 0.2, 80
FRAMES = 0.1 * np.arange(8)


def place(time: np.ndarray) -> np.ndarray:
    return np.cos(2.0 * np.pi * time / PERIOD)[:, None, None] * np.ones((3, 3))


def test_the_nodes_are_those_of_the_frames_after_the_trigger(tmp_path: Path) -> None:
    time = np.linspace(0.0, PERIOD, STEPS + 1)
    beat = Beat(time, {}, {}, {}, PERIOD, TRIGGER, positions=place(time))
    write_simulated_motion(tmp_path / "motion.npz", beat, FRAMES)
    restored = read_simulated_motion(tmp_path / "motion.npz")
    assert restored is not None
    assert restored.times == pytest.approx(FRAMES)
    assert restored.positions == pytest.approx(place(FRAMES + TRIGGER), abs=1e-12)


def test_a_failed_beat_is_a_motion_without_phases(tmp_path: Path) -> None:
    write_simulated_motion(tmp_path / "motion.npz", failed_beat("inverted", PERIOD, TRIGGER, {}), FRAMES)
    assert read_simulated_motion(tmp_path / "motion.npz") is None


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="missing"):
        read_simulated_motion(tmp_path / "nothing.npz")
