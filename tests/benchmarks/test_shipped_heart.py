"""The shipped heart is the published one: its files by their checksums, its voxels wherever a study reads them."""

import gzip
import hashlib
from pathlib import Path

import numpy as np
import pytest

from benchmarks.shipped_heart import PUBLISHED, ship
from heartfit.core.errors import InputError
from heartfit.imaging.registration.slices import region_about
from heartfit.imaging.sequence import ImageSequence
from heartfit.io.files import checksum, read_manifest
from heartfit.io.images import read_images
from heartfit.io.measured_heart import read_measured_heart, short_axis_images

VOXELS = "192c279b71df22052c6e11e2630a56e147c97495f40e544ab728766bba8a4fe9"
"""SHA-256 of the shipped voxels as int16, little end first."""
LARGEST_FILE, LARGEST_FOLDER = 1_000_000, 4_000_000


def files_in(folder: Path) -> list[Path]:
    return [file for file in folder.rglob("*") if file.is_file()]


def cine_of(folder: Path) -> ImageSequence:
    heart = read_measured_heart(folder)
    return read_images(short_axis_images(folder) or folder, heart.period, heart.times)


def test_the_fit_is_the_published_one(measured_heart_folder: Path) -> None:
    rows = read_manifest(PUBLISHED)
    assert len(rows) == 1 + 25 + 3
    for row in rows:
        assert checksum(measured_heart_folder / row["file"]) == row["sha256"], row["file"]


def test_the_voxels_are_those_that_were_shipped(measured_heart_folder: Path) -> None:
    cine = read_images(measured_heart_folder / "cine" / "sax")
    assert hashlib.sha256(cine.voxels.astype("<i2").tobytes()).hexdigest() == VOXELS
    heart = read_measured_heart(measured_heart_folder)
    assert (cine.period, *cine.times) == (heart.period, *heart.times)


def test_the_heart_is_small(measured_heart_folder: Path) -> None:
    sizes = [file.stat().st_size for file in files_in(measured_heart_folder)]
    assert max(sizes) < LARGEST_FILE
    assert sum(sizes) < LARGEST_FOLDER


@pytest.mark.published
def test_surfaces_and_voxels_are_equal_to_the_published_ones(
    measured_heart_folder: Path, published_heart_folder: Path
) -> None:
    here, there = map(read_measured_heart, (measured_heart_folder, published_heart_folder))
    for name in ("positions", "times", "period"):
        assert np.array_equal(getattr(here, name), getattr(there, name)), name
    assert np.array_equal(here.surface.triangles, there.surface.triangles)
    assert np.array_equal(here.surface.labels, there.surface.labels)
    cine, whole = map(cine_of, (measured_heart_folder, published_heart_folder))
    for name in ("size", "spacing", "origin", "direction"):
        assert np.array_equal(getattr(cine.grid, name), getattr(whole.grid, name)), name
    rows, columns = region_about(whole.grid, there.surface.points)
    expected = np.zeros_like(whole.voxels)
    expected[:, :, rows, columns] = whole.voxels[:, :, rows, columns]
    assert np.array_equal(cine.voxels, expected)


@pytest.mark.published
def test_the_shipped_heart_is_remade(
    tmp_path: Path, measured_heart_folder: Path, published_heart_folder: Path
) -> None:
    ship(published_heart_folder, tmp_path)
    written = {file.relative_to(tmp_path) for file in files_in(tmp_path)}
    for name in written:  # compressed files of another zlib may differ
        here, there = ((folder / name).read_bytes() for folder in (tmp_path, measured_heart_folder))
        unpack = gzip.decompress if name.suffix == ".gz" else bytes
        assert unpack(here) == unpack(there), name
    kept = {file.relative_to(measured_heart_folder) for file in files_in(measured_heart_folder)}
    assert {name.as_posix() for name in kept - written} == {"README.md", "published.tsv", "cine/timing.json"}


def test_a_file_that_is_not_the_published_one_is_not_shipped(tmp_path: Path) -> None:
    (tmp_path / "LICENSE").write_text("none\n")
    with pytest.raises(InputError, match="LICENSE: not the published file"):
        ship(tmp_path, tmp_path / "new")
