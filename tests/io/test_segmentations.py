"""Volumes of labels: read back as written; invalid ones are refused in one line."""

from pathlib import Path

import numpy as np
import pytest
import SimpleITK as sitk

from heartfit.core.errors import InputError
from heartfit.imaging.segmentation.stack import Segmentation
from heartfit.imaging.sequence import Grid
from heartfit.io.segmentations import read_segmentation, write_segmentation

LABELS = {"lv_cavity": 3, "lv_wall": 2, "rv_cavity": 1}


@pytest.fixture
def frames() -> tuple[Segmentation, ...]:
    grid = Grid((6, 5, 4), np.array([1.5e-3, 1.25e-3, 8e-3]), np.array([0.01, -0.02, 0.03]), np.eye(3))
    codes = np.random.default_rng(3).integers(0, 4, (8, *grid.shape))
    return tuple(Segmentation(grid, {name: code == n for name, n in LABELS.items()}) for code in codes)


@pytest.mark.parametrize("suffix", [".nii.gz", ".nrrd", ".mha"])
@pytest.mark.parametrize("count", [1, 8])
def test_round_trip(tmp_path: Path, frames: tuple[Segmentation, ...], suffix: str, count: int) -> None:
    file = tmp_path / f"labels{suffix}"
    write_segmentation(file, frames[:count], LABELS)
    restored = read_segmentation(file, LABELS)
    assert len(restored) == count
    for one, other in zip(restored, frames, strict=False):
        np.testing.assert_allclose(one.grid.points(np.ones(3)), other.grid.points(np.ones(3)), atol=1e-9)
        for name in LABELS:
            assert np.array_equal(one.parts[name], other.parts[name])


@pytest.mark.parametrize(
    ("labels", "what"),
    [
        ({"lv_cavity": 1, "lv_wall": 2}, "no number is stated for rv_cavity"),
        ({**LABELS, "rv_wal": 4}, "did you mean rv_wall"),
        ({**LABELS, "rv_cavity": 2}, "lv_wall are both 2"),
        ({**LABELS, "rv_cavity": 0}, "the surroundings are both 0"),
        ({**LABELS, "rv_cavity": 7}, "no voxel has 7, stated for rv_cavity; found are 1, 2, 3"),
    ],
)
def test_implausible_labels_are_refused(
    tmp_path: Path, frames: tuple[Segmentation, ...], labels: dict[str, int], what: str
) -> None:
    file = tmp_path / "labels.nrrd"
    write_segmentation(file, frames[:1], LABELS)
    with pytest.raises(InputError, match=what):
        read_segmentation(file, labels)


def test_an_image_is_refused_as_a_segmentation(tmp_path: Path) -> None:
    file = tmp_path / "image.nrrd"
    sitk.WriteImage(sitk.GetImageFromArray(np.full((3, 3, 3), 1.37, np.float32)), str(file))
    with pytest.raises(InputError, match=r"no whole numbers, the first 1\.37"):
        read_segmentation(file, LABELS)
    sitk.WriteImage(sitk.GetImageFromArray(np.full((3, 3, 3), np.nan, np.float32)), str(file))
    with pytest.raises(InputError, match="no whole numbers, the first nan"):
        read_segmentation(file, LABELS)


def test_a_truncated_or_flat_file_is_refused(tmp_path: Path, frames: tuple[Segmentation, ...]) -> None:
    file = tmp_path / "labels.nii.gz"
    write_segmentation(file, frames[:1], LABELS)
    file.write_bytes(file.read_bytes()[:-40])
    with pytest.raises(InputError, match=r"labels\.nii\.gz"):
        read_segmentation(file, LABELS)
    flat = tmp_path / "flat.mha"
    sitk.WriteImage(sitk.GetImageFromArray(np.ones((3, 3), np.uint8)), str(flat))
    with pytest.raises(InputError, match="2-D"):
        read_segmentation(flat, LABELS)
