"""Rounding errors on purpose are as large as stated, the same in every job, and reach what follows from them."""

from pathlib import Path

import numpy as np
import pytest

from heartfit.geometry.cube import cube
from heartfit.geometry.mesh import Motion
from heartfit.imaging.registration.track import FreeForm, track
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.io.images import read_images, write_images
from heartfit.io.jitter import MEMBER, RELATIVE, moved_positions, moved_voxels
from heartfit.io.meshes import read_mesh, read_motion, write_motion
from heartfit.io.templates import TEMPLATES
from heartfit.observation.shape import cavity_volumes
from tests.sources import ROOT

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


def differences(first: np.ndarray, other: np.ndarray) -> float:
    """Largest relative difference, which is not zero."""
    largest = float(np.abs(first - other).max() / np.abs(first).max())
    assert largest > 0.0
    return largest


def test_a_moved_mesh_and_a_moved_motion_change_the_last_digits_of_a_volume(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = ROOT / TEMPLATES / "17_1.vtu"
    mesh = read_mesh(file)
    still = Motion(np.linspace(0.0, 0.7, 8), 0.8, np.repeat(mesh.points[None], 8, axis=0))
    write_motion(tmp_path / "motion.npz", still)
    volumes = cavity_volumes(mesh, still)
    monkeypatch.setenv(MEMBER, "1")
    again = cavity_volumes(read_mesh(file), read_motion(tmp_path / "motion.npz"))
    assert differences(volumes["lv_volume"].values, again["lv_volume"].values) < 1e-10


def test_moved_voxels_change_a_registered_motion(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    grid = Grid((14, 14, 14), np.full(3, 3e-3), np.full(3, -3e-3), np.eye(3))
    centres = np.moveaxis(np.indices((14, 14, 14)), 0, -1) * 3e-3 - 3e-3
    times = 0.1 * np.arange(8)
    shift = 3e-3 * np.sin(np.pi * times / 0.8) ** 2
    voxels = [np.sin((centres + step) @ np.array([600.0, 500.0, 700.0])) for step in shift]
    write_images(tmp_path / "a.nrrd", ImageSequence(grid, np.array(voxels, np.float32), times, 0.8))
    registered = track(read_images(tmp_path / "a.nrrd"), cube(2, 36e-3), FreeForm()).motion.positions
    monkeypatch.setenv(MEMBER, "1")
    again = track(read_images(tmp_path / "a.nrrd"), cube(2, 36e-3), FreeForm()).motion.positions
    assert differences(registered, again) < 1e-3
