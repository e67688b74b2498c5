"""A DICOM cine becomes one sequence, its slices in place and its frames in time, or is refused with the file named."""

import shutil
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import pytest
import SimpleITK as sitk

from heartfit.core.errors import InputError
from heartfit.io.images import read_images

FRAMES, SLICES = 8, 3
PIXEL, STEP = 1.5, 10.0  # mm
ORIGIN = np.array([-40.0, 15.0, 70.0])
BEATS = (700.0, 910.0, 850.0)  # ms, each slice in its own breath-hold
COSINE = np.sqrt(0.5)
DIRECTION = np.array([[COSINE, 0.0, COSINE], [0.0, 1.0, 0.0], [-COSINE, 0.0, COSINE]])


def pixels(place: int, frame: int) -> np.ndarray:
    return (100 * place + 10 * frame + np.arange(30).reshape(5, 6)).astype(np.int16)


def text(*values: float) -> str:
    return "\\".join(f"{value:.10g}" for value in values)


def tags(place: int, frame: int) -> dict[str, str]:
    return {
        "0008|0018": f"1.2.3.{place}.{frame + 1}",
        "0008|0060": "MR",
        "0018|0050": "8",
        "0018|1060": text(frame * BEATS[place] / FRAMES),
        "0018|1062": text(BEATS[place]),
        "0020|000d": "1.2.3",
        "0020|000e": f"1.2.3.{place + 7}",
        "0020|0052": "1.2.4",
        "0020|0100": text(frame + 1),
    }


def write(
    file: Path,
    place: int,
    frame: int,
    change: Mapping[str, str] | None = None,
    offset: tuple[float, ...] = (0, 0, 0),
    direction: np.ndarray = DIRECTION,
    pixel: float = PIXEL,
) -> None:
    image = sitk.GetImageFromArray(pixels(place, frame)[None])
    image.SetSpacing([pixel, pixel, 8.0])
    image.SetDirection(direction.ravel().tolist())
    image.SetOrigin((ORIGIN + place * STEP * DIRECTION[:, 2] + DIRECTION @ offset).tolist())
    for key, value in (tags(place, frame) | dict(change or {})).items():
        if value:
            image.SetMetaData(key, value)
    writer = sitk.ImageFileWriter()
    writer.KeepOriginalImageUIDOn()
    writer.SetFileName(str(file))
    writer.Execute(image)


def name(place: int, frame: int) -> str:
    """Names that sort neither by place nor by time."""
    return f"IM{(7 * frame + 5 * place) % 24:02d}_{place}{frame}.dcm"


def stack(folder: Path, change: Callable[[int, int], Mapping[str, str]] = lambda place, frame: {}) -> Path:
    for place in range(SLICES):
        (folder / f"series{9 - place}").mkdir(parents=True)
        for frame in range(FRAMES):
            write(folder / f"series{9 - place}" / name(place, frame), place, frame, change(place, frame))
    return folder


@pytest.fixture
def cine(tmp_path: Path) -> Path:
    return stack(tmp_path / "cine")


def file(folder: Path, place: int, frame: int) -> Path:
    return folder / f"series{9 - place}" / name(place, frame)


def test_slices_are_in_place_and_frames_in_time(cine: Path) -> None:
    sequence = read_images(cine)
    expected = [[pixels(place, frame) for place in range(SLICES)] for frame in range(FRAMES)]
    assert np.array_equal(sequence.voxels, np.array(expected, np.float32))
    assert sequence.grid.spacing == pytest.approx([1e-3 * PIXEL, 1e-3 * PIXEL, 1e-3 * STEP])
    assert sequence.grid.origin == pytest.approx(1e-3 * ORIGIN)
    assert sequence.grid.direction == pytest.approx(DIRECTION)
    assert sequence.period == pytest.approx(0.82)
    assert sequence.times == pytest.approx(np.arange(FRAMES) * 0.82 / FRAMES)


def test_trigger_times_need_not_be_even(tmp_path: Path) -> None:
    late = 4.0 + np.arange(FRAMES) * 90.0 + 10.0 * (np.arange(FRAMES) % 2)
    folder = stack(
        tmp_path / "cine", lambda place, frame: {"0018|1060": text(late[frame]), "0018|1062": "830"}
    )
    assert read_images(folder).times == pytest.approx(1e-3 * late)


def test_temporal_positions_do_where_there_are_no_trigger_times(tmp_path: Path) -> None:
    folder = stack(
        tmp_path / "cine", lambda place, frame: {"0018|1060": "", "0018|1062": "", "0018|1088": "75"}
    )
    sequence = read_images(folder)
    assert sequence.period == pytest.approx(0.8)
    assert sequence.times == pytest.approx(0.1 * np.arange(FRAMES))
    assert sequence.voxels[3, 1, 0, 0] == pixels(1, 3)[0, 0]


def test_the_caller_knows_the_beat_that_the_files_do_not_tell(tmp_path: Path) -> None:
    folder = stack(tmp_path / "cine", lambda place, frame: {"0018|1060": text(90.0 * frame), "0018|1062": ""})
    assert read_images(folder, period=0.85).times == pytest.approx(0.09 * np.arange(FRAMES))
    with pytest.raises(InputError, match="cine: the length of the beat is not stated"):
        read_images(folder)


def test_one_slice_has_the_thickness_of_its_tag(tmp_path: Path) -> None:
    (tmp_path / "long").mkdir()
    for frame in range(FRAMES):
        write(tmp_path / "long" / name(0, frame), 0, frame)
    assert read_images(tmp_path / "long").grid.spacing[2] == pytest.approx(8e-3)


def cut_off(folder: Path) -> None:
    victim = file(folder, 1, 4)
    victim.write_bytes(victim.read_bytes()[:-40])


def without_frame(folder: Path) -> None:
    for place in range(SLICES):
        file(folder, place, 4).unlink()


def again(place: int, frame: int, **change: object) -> Callable[[Path], None]:
    """One picture written anew."""
    return lambda folder: write(file(folder, place, frame), place, frame, **change)  # type: ignore[arg-type]


def also(place: int, frame: int, change: Mapping[str, str]) -> Callable[[Path], None]:
    """One picture more."""
    return lambda folder: write(folder / "more.dcm", place, frame, change)


TILTED = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (cut_off, name(1, 4) + ": not a sound DICOM image"),
        (lambda folder: (folder / "notes.txt").write_text("x"), r"notes\.txt: not a sound DICOM image"),
        (
            lambda folder: file(folder, 1, 4).unlink(),
            "series8: slice at .*: frames 3 and 4 are 2.0 times as far",
        ),
        (lambda folder: file(folder, 1, 7).unlink(), r"series8: slice at .*: 7 frames, other slices have 8"),
        (without_frame, "frames 3 and 4 are 2.0 times as far"),
        (lambda folder: shutil.copy(file(folder, 1, 4), folder), "same place and time as .*; one is a copy"),
        (also(1, 4, {"0020|000e": "1.2.9"}), r"same place and time as .*; two series are mixed"),
        (also(1, 4, {"0020|000d": "9.9"}), "another study than"),
        (also(1, 4, {"0020|0052": "9.9"}), "another frame of reference than"),
        (again(1, 4, direction=TILTED), name(1, 4) + ": other axes"),
        (again(1, 4, pixel=1.6), name(1, 4) + r": spacing \(1.6, 1.6, 8\) mm, expected \(1.5, 1.5, 8\) mm"),
        (again(1, 4, offset=(2.0, 0.0, 0.0)), name(1, 4) + ": first voxel at"),
        (
            again(1, 4, change={"0018|1060": "", "0020|0100": ""}),
            name(1, 4) + ": no trigger time and no temporal",
        ),
        (again(1, 4, change={"0018|1060": "soon"}), "expected a number|not a sound DICOM image"),
    ],
)
def test_a_spoilt_cine_is_refused(
    cine: Path, spoil: Callable[[Path], object], message: str, capfd: pytest.CaptureFixture[str]
) -> None:
    spoil(cine)
    with pytest.raises(InputError, match=message) as caught:
        read_images(cine)
    assert "\n" not in str(caught.value)
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize(
    ("place", "message"), [(4.0, "20.0 mm away, the others 10.0 mm; a slice is missing"), (2.4, "mixed")]
)
def test_slices_that_are_not_evenly_spaced_are_refused(cine: Path, place: float, message: str) -> None:
    (cine / "more").mkdir()
    for frame in range(FRAMES):
        write(cine / "more" / name(2, frame), 2, frame, offset=(0.0, 0.0, (place - 2.0) * STEP))
    with pytest.raises(InputError, match=message):
        read_images(cine)


def test_slices_of_different_phases_are_refused(tmp_path: Path) -> None:
    def late(place: int, frame: int) -> dict[str, str]:
        return {"0018|1060": text(95.0 * frame + 90.0 * (place == 1)), "0018|1062": "860"}

    with pytest.raises(InputError, match=r"series8: slice at .* frames 60 ms off those of other slices"):
        read_images(stack(tmp_path / "cine", late))


def test_one_slice_of_unknown_thickness_is_refused(tmp_path: Path) -> None:
    step, other = b"\x18\x00\x88\x00", b"\x18\x00\x89\x00"
    for frame in range(FRAMES):
        file = tmp_path / name(0, frame)
        write(file, 0, frame, {"0018|0050": ""})
        assert step in file.read_bytes()
        file.write_bytes(file.read_bytes().replace(step, other))
    with pytest.raises(InputError, match="one slice of unknown thickness"):
        read_images(tmp_path)
