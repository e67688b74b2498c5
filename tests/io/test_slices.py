"""The motion of slices is read back as it was written."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.imaging.registration.slices import SliceMotion
from heartfit.imaging.sequence import Grid
from heartfit.io.slice_motions import read_slice_motion, write_slice_motion


def test_round_trip_to_single_precision(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    grid = Grid((30, 20, 2), np.array([1e-3, 2e-3, 1e-2]), rng.normal(size=3), axes)
    motion = SliceMotion(grid, (4, 5), rng.normal(0.0, 3.0, (8, 2, 9, 11, 2)))
    first, second = tmp_path / "first.npz", tmp_path / "second.npz"
    write_slice_motion(first, motion)
    restored = read_slice_motion(first)
    write_slice_motion(second, restored)
    assert first.read_bytes() == second.read_bytes()
    assert restored.displacement == pytest.approx(motion.displacement, abs=1e-6)
    points = grid.points(rng.uniform(0.0, 1.0, (7, 3)) * [9.0, 7.0, 0.0] + [4.0, 5.0, 1.0])
    assert restored.carry(points) == pytest.approx(motion.carry(points), abs=1e-8)
    with pytest.raises(InputError, match="no such file"):
        read_slice_motion(tmp_path / "nothing.npz")
