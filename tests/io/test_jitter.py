"""Rounding errors on purpose are as large as stated, the same in every job, and reach what follows from them."""

import numpy as np
import pytest

from heartfit.io.jitter import MEMBER, RELATIVE, moved_positions, moved_voxels

POSITIONS = np.random.default_rng(0).normal(size=(50, 3))
VOXELS = np.random.default_rng(1).normal(size=(4, 5, 6)).astype(np.float32)
VOXELS[0] = 0.0


def test_without_a_member_nothing_moves(monkeypatch: pytest.MonkeyPatch) -> None:
    for value in (None, "0"):
        monkeypatch.delenv(MEMBER, raising=False) if value is None else monkeypatch.setenv(MEMBER, value)
        assert moved_positions(POSITIONS) is POSITIONS
        assert moved_voxels(VOXELS) is VOXELS


def test_every_job_of_a_member_reads_the_same_and_members_differ(monkeypatch: pytest.MonkeyPatch) -> None:
    read = []
    for member in ("1", "1", "2"):
        monkeypatch.setenv(MEMBER, member)
        read.append((moved_positions(POSITIONS), moved_voxels(VOXELS)))
    first, again, other = read
    assert all(map(np.array_equal, first, again))
    assert not any(map(np.array_equal, first, other))


def test_positions_move_by_their_last_digits_and_voxels_to_the_next_number(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv(MEMBER, "3")
    relative = np.abs(moved_positions(POSITIONS) / POSITIONS - 1.0)
    assert 0.5 * RELATIVE < relative.max() <= 1.001 * RELATIVE
    voxels = moved_voxels(VOXELS)
    assert voxels.dtype == np.float32
    assert (voxels[0] == 0.0).all()
    up, down = (np.nextafter(VOXELS[1:], np.float32(end)) for end in (np.inf, -np.inf))
    assert ((voxels[1:] == up) | (voxels[1:] == down)).all()
    assert 0.3 < np.mean(voxels[1:] == up) < 0.7
