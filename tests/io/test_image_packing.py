"""Compressed voxels that are damaged are refused, wherever the byte lies; sound ones are read from any kind of file."""

from pathlib import Path

import numpy as np
import pytest
import SimpleITK as sitk

from heartfit.core.errors import InputError
from heartfit.io.image_file import load, numbers

BESIDE = {".mha": "x.mha", ".mhd": "x.zraw", ".nrrd": "x.nrrd", ".nhdr": "x.raw.gz", ".nii.gz": "x.nii.gz"}
"""File of the voxels, by the suffix of the header."""

HEADERS = 700
"""Bytes, at most, that a header takes of a file that holds both."""


@pytest.fixture
def voxels() -> np.ndarray:
    """Half of them noise, half of them few values, which are packed otherwise."""
    noise = np.random.default_rng(0).normal(100.0, 20.0, (6, 20, 12)).astype(np.float32)
    noise[:3] = np.round(noise[:3] / 50.0)
    return noise


@pytest.fixture(params=BESIDE)
def image(request: pytest.FixtureRequest, voxels: np.ndarray, tmp_path: Path) -> Path:
    path = tmp_path / f"x{request.param}"
    sitk.WriteImage(sitk.GetImageFromArray(voxels), str(path), useCompression=True)
    return path


def holder(image: Path) -> Path:
    return image.with_name(BESIDE[image.name[1:]])


def test_sound_voxels_are_read(image: Path, voxels: np.ndarray) -> None:
    np.testing.assert_array_equal(numbers(load(image)), voxels)


def test_a_changed_byte_is_detected(image: Path) -> None:
    sound, rng = holder(image).read_bytes(), np.random.default_rng(0)
    begin = HEADERS if holder(image) == image else 10  # the ten of gzip's own head may differ
    for place, change in zip(rng.integers(begin, len(sound) - 8, 20), rng.integers(1, 256, 20), strict=True):
        content = bytearray(sound)
        content[place] ^= int(change)
        holder(image).write_bytes(content)
        with pytest.raises(InputError, match="damaged"):
            load(image)


@pytest.mark.parametrize("share", [0.3, 0.9, 0.999])
def test_voxels_that_break_off_are_refused(image: Path, share: float) -> None:
    content = holder(image).read_bytes()
    holder(image).write_bytes(content[: int(share * len(content))])
    with pytest.raises(InputError, match="cut off"):
        load(image)


def with_length(voxels: np.ndarray, path: Path, stated: str) -> Path:
    """MetaImage that states another length of its compressed voxels; a dot stands for the true one."""
    sitk.WriteImage(sitk.GetImageFromArray(voxels), str(path), useCompression=True)
    content = path.read_bytes()
    name, length = next(line.split(b" = ") for line in content.splitlines() if b"DataSize" in line)
    path.write_bytes(
        content.replace(name + b" = " + length, name + b" = " + stated.encode().replace(b".", length))
    )
    return path


def test_a_length_that_leaves_voxels_out_is_refused(voxels: np.ndarray, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="damaged"):
        load(with_length(voxels, tmp_path / "x.mha", "99"))


@pytest.mark.parametrize("length", [".0", "99999999999999", "9" * 30, "9" * 5000])
def test_a_length_beyond_the_file_allocates_no_memory(
    voxels: np.ndarray, tmp_path: Path, length: str
) -> None:
    with pytest.raises(InputError, match=r"x\.mha: cannot be read"):
        load(with_length(voxels, tmp_path / "x.mha", length))
