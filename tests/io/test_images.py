"""Image sequences are read back as written; invalid files are named with their fault."""

import json
import shutil
import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import SimpleITK as sitk
from hypothesis import given, settings
from hypothesis import strategies as st

from heartfit.core.errors import InputError
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.io.images import read_images, write_images

WRITTEN = (".nrrd", ".nii.gz", ".mha")
PLACE = {".nrrd": 1e-15, ".mha": 1e-15, ".nii.gz": 3e-8}
"""Tolerance of the place of a voxel [m]: round-off of double and of single precision at 0.3 m."""


def turned(rng: np.random.Generator) -> np.ndarray:
    """Any directions at right angles, right-handed or left-handed."""
    return np.linalg.qr(rng.standard_normal((3, 3)))[0]


def sequence(seed: int = 0, frames: int = 9, size: tuple[int, int, int] = (5, 4, 3)) -> ImageSequence:
    rng = np.random.default_rng(seed)
    grid = Grid(size, rng.uniform(1e-3, 1e-2, 3), rng.uniform(-0.3, 0.3, 3), turned(rng))
    times = (np.arange(frames) + rng.uniform(0.0, 0.3, frames)) * 0.8 / frames
    return ImageSequence(grid, rng.standard_normal((frames, *grid.shape)).astype(np.float32), times, 0.8)


@pytest.mark.parametrize("suffix", WRITTEN)
@settings(max_examples=15, deadline=None, derandomize=True)
@given(seed=st.integers(0, 2**31), frames=st.integers(8, 12), size=st.tuples(*[st.integers(1, 6)] * 3))
def test_round_trip(
    tmp_path_factory: pytest.TempPathFactory, suffix: str, seed: int, frames: int, size: tuple[int, int, int]
) -> None:
    written, path = (
        sequence(seed, frames, (max(size[0], 2), *size[1:])),
        tmp_path_factory.mktemp("x") / f"a{suffix}",
    )
    write_images(path, written)
    restored = read_images(path)
    assert np.array_equal(restored.voxels, written.voxels)
    assert np.array_equal(restored.times, written.times)
    assert restored.period == written.period
    corners = np.array([[0.0, 0.0, 0.0], np.array(size) - 1.0])
    assert restored.grid.points(corners) == pytest.approx(written.grid.points(corners), abs=PLACE[suffix])


@pytest.mark.parametrize("suffix", WRITTEN)
def test_the_same_sequence_is_the_same_bytes(tmp_path: Path, suffix: str) -> None:
    for folder in "ab":
        write_images(tmp_path / folder / f"cine{suffix}", sequence())
    first, second = ({file.name: file.read_bytes() for file in (tmp_path / x).iterdir()} for x in "ab")
    assert first == second
    assert set(first) == {f"cine{suffix}", "cine.json"}


def test_unknown_suffixes_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"written as \.nrrd"):
        write_images(tmp_path / "cine.png", sequence())
    assert not list(tmp_path.iterdir())


def nifti(folder: Path, xyzt_units: int = 10, spacing: float = 0.09) -> Path:
    """A NIfTI without sidecar whose header gives the time between frames in this unit."""
    path = folder / "cine.nii"
    image = sitk.GetImageFromArray(sequence().voxels, isVector=False)
    image.SetSpacing([1.0, 1.0, 1.0, spacing])
    sitk.WriteImage(image, str(path))
    header = bytearray(path.read_bytes())
    header[123] = xyzt_units
    path.write_bytes(bytes(header))
    return path


@pytest.mark.parametrize(("unit", "spacing"), [(10, 0.09), (18, 90.0), (26, 9e4)], ids=["s", "ms", "us"])
def test_a_nifti_that_states_its_unit_needs_no_sidecar(tmp_path: Path, unit: int, spacing: float) -> None:
    restored = read_images(nifti(tmp_path, unit, spacing))
    assert restored.period == pytest.approx(0.81, rel=1e-6)
    assert restored.times == pytest.approx(0.09 * np.arange(9), rel=1e-6)
    assert restored.grid.spacing.tolist() == [1e-3] * 3


def test_times_of_the_caller_precede_the_sidecar_and_the_header(tmp_path: Path) -> None:
    path = nifti(tmp_path)
    (tmp_path / "cine.json").write_text('{"period_s": 0.9, "RepetitionTime": 0.0027}')
    assert read_images(path).period == 0.9
    assert read_images(path).times[1] == pytest.approx(0.09)
    late = 0.01 + 0.1 * np.arange(9)
    restored = read_images(path, period=1.0, times=late)
    assert restored.period == 1.0
    assert np.array_equal(restored.times, late)


def test_without_times_frames_are_evenly_spread_over_the_period(tmp_path: Path) -> None:
    write_images(tmp_path / "a.nrrd", sequence())
    (tmp_path / "a.json").unlink()
    assert read_images(tmp_path / "a.nrrd", period=0.9).times == pytest.approx(0.1 * np.arange(9))


@pytest.mark.parametrize("unit", [2, 34], ids=["none", "hertz"])
def test_a_nifti_without_a_unit_of_time_is_refused(tmp_path: Path, unit: int) -> None:
    with pytest.raises(InputError, match=r"cine\.nii: the length of the beat is not stated"):
        read_images(nifti(tmp_path, unit))


def cut_off(folder: Path, suffix: str) -> Path:
    path = folder / f"cine{suffix}"
    write_images(path, sequence(size=(9, 8, 7)))
    path.write_bytes(path.read_bytes()[:-900])
    return path


@pytest.mark.parametrize("suffix", WRITTEN)
def test_a_file_that_is_cut_off_is_refused_in_one_line(
    tmp_path: Path, suffix: str, capfd: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(InputError, match=f"cine{suffix}: .*cut off") as caught:
        read_images(cut_off(tmp_path, suffix))
    assert "\n" not in str(caught.value)
    assert capfd.readouterr().err == ""


def test_an_uncompressed_nifti_that_is_cut_off_is_refused(tmp_path: Path) -> None:
    path = nifti(tmp_path)
    path.write_bytes(path.read_bytes()[:-4])
    with pytest.raises(InputError, match="2508 bytes or more, expected 2512; it is cut off"):
        read_images(path)


def unplaced(path: Path) -> None:
    header = bytearray(path.read_bytes())
    header[252:256] = struct.pack("<hh", 0, 0)
    path.write_bytes(bytes(header))


def skewed(path: Path) -> None:
    header = bytearray(path.read_bytes())
    header[252:256] = struct.pack("<hh", 0, 1)
    header[280:296] = struct.pack("<4f", 1.0, 0.7, 0.0, 0.0)
    path.write_bytes(bytes(header))


def as_3d(path: Path) -> None:
    sitk.WriteImage(sitk.Image([3, 3, 3], sitk.sitkFloat32), str(path))


def coloured(path: Path) -> None:
    sitk.WriteImage(sitk.Image([3, 3, 3], sitk.sitkVectorFloat32, 9), str(path))


def sidecar(text: str) -> Callable[[Path], None]:
    return lambda path: path.with_suffix(".json").write_text(text)  # type: ignore[return-value]


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (Path.unlink, r"cine\.nii: no such file"),
        (lambda path: path.write_text("text"), r"cine\.nii: cannot be read: .*no image"),
        (unplaced, "neither qform nor sform is set"),
        (skewed, "cannot be read: .*orthonormal"),
        (as_3d, r"cine\.nii: 3-D, numbers in a voxel 1"),
        (coloured, r"cine\.nii: .*voxel 9; expected 4-D"),
        (sidecar('{"period_s": 27}'), "a beat of 27 s; expected 0.2 to 3 s"),
        (sidecar('{"period_ms": 829}'), r"cine\.json: unknown key period_ms; expected period_s or times_s"),
        (sidecar('{"period_s": "long"}'), r"cine\.json: could not convert"),
        (sidecar("{"), r"cine\.json: .*expected \{"),
        (sidecar("[0.8]"), r"cine\.json: .*expected \{"),
        (sidecar('{"times_s": [0, 0.1]}'), "2 times for 9 frames"),
        (
            sidecar('{"times_s": [0, 0.09, 0.18, 0.27, 0.45, 0.54, 0.63, 0.72, 0.81], "period_s": 0.9}'),
            "frames 3 and 4 are 2.0 times as far apart as usual; a frame is missing",
        ),
        (sidecar('{"period_s": 0.5}'), r"cine\.nii: .*times run from 0 to 0.72 s"),
    ],
)
def test_an_invalid_sequence_is_refused_in_one_line(
    tmp_path: Path, spoil: Callable[[Path], object], message: str, capfd: pytest.CaptureFixture[str]
) -> None:
    path = nifti(tmp_path)
    spoil(path)
    with pytest.raises(InputError, match=message) as caught:
        read_images(path)
    assert "\n" not in str(caught.value)
    assert capfd.readouterr().err == ""


@pytest.fixture
def frames(tmp_path: Path) -> Path:
    """A folder with a frame in each file, the tenth sorting before the second, and the times beside it."""
    write_images(tmp_path / "all.nrrd", sequence(frames=12))
    image = sitk.ReadImage(str(tmp_path / "all.nrrd"))
    (tmp_path / "cine").mkdir()
    for number in range(12):
        suffix = ".nii.gz" if number % 2 else ".mha"
        sitk.WriteImage(image[:, :, :, number], str(tmp_path / "cine" / f"p1_{number}_sax{suffix}"))
    shutil.copyfile(tmp_path / "all.json", tmp_path / "cine.json")
    return tmp_path / "cine"


def test_a_folder_of_frames_is_the_same_sequence(frames: Path) -> None:
    restored, expected = read_images(frames), read_images(frames.with_name("all.nrrd"))
    assert np.array_equal(restored.voxels, expected.voxels)
    assert np.array_equal(restored.times, expected.times)
    assert restored.grid.direction == pytest.approx(expected.grid.direction)


def rewritten(change: Callable[[sitk.Image], sitk.Image | None]) -> Callable[[Path], None]:
    """Change the image of frame 4."""

    def spoil(folder: Path) -> None:
        file = folder / "p1_4_sax.mha"
        image = sitk.ReadImage(str(file))
        sitk.WriteImage(change(image) or image, str(file))

    return spoil


def mirrored(image: sitk.Image) -> None:
    image.SetDirection((np.array(image.GetDirection()).reshape(3, 3) @ np.diag([-1, 1, 1])).ravel().tolist())


def farther(image: sitk.Image) -> None:
    image.SetSpacing(np.multiply(image.GetSpacing(), (1.0, 1.0, 1.01)).tolist())


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (lambda folder: (folder / "p1_4_sax.mha").unlink(), "frames 0 to 11, but 4 missing"),
        (
            lambda folder: shutil.copyfile(folder / "p1_4_sax.mha", folder / "p1_04_sax.mha"),
            r"p1_4_sax\.mha: the number of frame p1_04_sax\.mha",
        ),
        (
            lambda folder: shutil.copyfile(folder / "p1_4_sax.mha", folder / "p2_4_sax.mha"),
            r"p2_4_sax\.mha: expected a name p1_<number>_sax",
        ),
        (
            lambda folder: shutil.copyfile(folder / "p1_4_sax.mha", folder / "mask.mha"),
            r"mask\.mha: no number",
        ),
        (rewritten(mirrored), r"p1_4_sax\.mha: other axes, expected those as in p1_0_sax\.mha"),
        (rewritten(farther), r"p1_4_sax\.mha: spacing .* mm, expected .* mm as in p1_0_sax\.mha"),
        (rewritten(lambda image: image[:, :, :2]), r"p1_4_sax\.mha: size \(5, 4, 2\), expected \(5, 4, 3\)"),
        (rewritten(lambda image: image[1:]), r"p1_4_sax\.mha: size"),
        (
            rewritten(lambda image: image.SetOrigin([0, 0, 0])),
            r"p1_4_sax\.mha: first voxel at \(0, 0, 0\) mm",
        ),
        (rewritten(lambda image: sitk.JoinSeries([image])), r"p1_4_sax\.mha: 4-D"),
        (lambda folder: folder.with_suffix(".json").unlink(), "cine: the length of the beat is not stated"),
        (
            lambda folder: folder.with_suffix(".json").write_text(
                json.dumps({"period_s": 0.8, "times_s": [0.0]})
            ),
            "1 times for 12 frames",
        ),
    ],
)
def test_a_spoilt_folder_is_refused(frames: Path, spoil: Callable[[Path], object], message: str) -> None:
    spoil(frames)
    with pytest.raises(InputError, match=message):
        read_images(frames)


def test_an_empty_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="holds no images"):
        read_images(tmp_path)


def test_the_measured_cine_is_where_and_when_it_was_taken(measured_heart_folder: Path) -> None:
    cine = read_images(measured_heart_folder / "cine" / "sax")
    assert cine.voxels.shape == (25, 6, 208, 256)
    assert cine.grid.spacing == pytest.approx([1.40625e-3, 1.40625e-3, 17.7e-3], rel=1e-5)
    assert cine.period == pytest.approx(0.829, abs=5e-4)
    assert np.linalg.det(cine.grid.direction) == pytest.approx(1.0)
