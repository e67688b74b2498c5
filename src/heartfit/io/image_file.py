"""Image files in the formats of SimpleITK, and folders with one 3-D file for each frame.

A damaged file is refused in one line.
"""

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.imaging.sequence import Grid
from heartfit.io.files import require_as_written
from heartfit.io.image_bytes import require_own_voxels, require_undamaged, require_whole
from heartfit.io.image_names import SUFFIXES, is_image, stem
from heartfit.io.text import require_file

MILLIMETRE = 1e-3
LARGEST_TILT = 1e-6


def load(path: Path) -> sitk.Image:
    """Read an image; raises InputError if it is missing, damaged, cut off, or a NIfTI without orientation."""
    require_file(path, f"an image ({', '.join(SUFFIXES)})")
    if not is_image(path):
        raise InputError(f"{path}: not a supported kind of image; expected {', '.join(SUFFIXES)}: convert it")
    require_as_written(path)
    require_own_voxels(path)
    try:
        with quiet():
            image = sitk.ReadImage(str(path))
    except RuntimeError as failure:
        raise InputError(
            f"{path}: cannot be read: {reason(failure)}; cut off, damaged or no image: export it again"
        ) from None
    require_undamaged(path, image)
    if path.name.endswith((".nii", ".nii.gz")):
        require_whole(path, image)
        if {image.GetMetaData("qform_code"), image.GetMetaData("sform_code")} == {"0"}:
            raise InputError(
                f"{path}: neither qform nor sform is set; expected one, to know left from right; export it again"
            )
    return image


def numbers(image: sitk.Image) -> Floats:
    """Voxels as float32, the last axis of the image first."""
    voxels: Floats = sitk.GetArrayFromImage(image).astype(np.float32, copy=False)
    return voxels


def grid_of(image: sitk.Image, where: Path) -> Grid:
    """Grid of the voxels; raises InputError that names the file, also if the fourth axis is not time alone."""
    dimension = image.GetDimension()
    direction = np.array(image.GetDirection()).reshape(dimension, dimension)
    tilt = max(np.abs(direction[3:, :3]).max(initial=0.0), np.abs(direction[:3, 3:]).max(initial=0.0))
    if tilt > LARGEST_TILT:
        raise InputError(
            f"{where}: its direction mixes space and time; expected time alone on the fourth axis"
        )
    i, j, k = image.GetSize()[:3]
    spacing, origin = (
        MILLIMETRE * np.array(vector[:3]) for vector in (image.GetSpacing(), image.GetOrigin())
    )
    try:
        return Grid((i, j, k), spacing, origin, direction[:3, :3])
    except InputError as fault:
        raise InputError(f"{where}: {fault}") from None


def reason(failure: RuntimeError) -> str:
    """Last line of a message of SimpleITK, without the place in its source.

    "Reason:" is left out: it belongs to whatever the operating system refused last.
    """
    lines = [line for line in str(failure).splitlines() if line.strip() and not line.startswith("Reason:")]
    return re.sub(r"^.*ERROR: |\w+\(0x[0-9a-f]+\): ", "", lines[-1]).strip().rstrip(".")


@contextmanager
def quiet() -> Iterator[None]:
    """Silence the standard error at its file descriptor, to which the libraries below SimpleITK write."""
    saved, sink = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(sink, 2)
    try:
        yield
    finally:
        os.dup2(saved, 2)
        os.close(sink)
        os.close(saved)


NUMBERED = re.compile(r"(.*?)(\d+)(\D*)")
SAME_SPACING, SAME_DIRECTION, SAME_PLACE = 1e-4, 1e-3, 1e-4
"""Tolerances above the rounding of NIfTI and DICOM: relative, of direction cosines, and in [m]."""


def read_frames(folder: Path) -> tuple[Grid, Floats]:
    """Read grid and voxels (p, k, j, i) of the frames in the order of the last number in their names.

    Raises InputError that names the file for a missing or repeated number, another series, an image that is not 3-D or
    has another grid than the first; and for gaps in the numbers.
    """
    files = _in_order(folder)
    grid, first = _frame(files[0])
    frames = [first]
    for file in files[1:]:
        other, voxels = _frame(file)
        require_alike(file, other, files[0], grid)
        frames.append(voxels)
    return grid, np.stack(frames)


def require_alike(file: Path, grid: Grid, first: Path, expected: Grid) -> None:
    """Raise InputError unless two files have the same grid of voxels."""
    alike = {
        f"size {grid.size}, expected {expected.size}": grid.size == expected.size,
        f"spacing {_mm(grid.spacing)} mm, expected {_mm(expected.spacing)} mm": np.allclose(
            grid.spacing, expected.spacing, rtol=SAME_SPACING, atol=0.0
        ),
        "other axes, expected those": np.allclose(
            grid.direction, expected.direction, rtol=0.0, atol=SAME_DIRECTION
        ),
        f"first voxel at {_mm(grid.origin)} mm, expected {_mm(expected.origin)} mm": np.allclose(
            grid.origin, expected.origin, rtol=0.0, atol=SAME_PLACE
        ),
    }
    difference = next((text for text, same in alike.items() if not same), None)
    if difference:
        raise InputError(
            f"{file}: {difference} as in {first.name}; every image must have the same box of voxels"
        )


def _mm(vector: Floats) -> str:
    return "(" + ", ".join(f"{1e3 * value:.6g}" for value in vector) + ")"


def _in_order(folder: Path) -> list[Path]:
    numbered: dict[int, Path] = {}
    series: tuple[str, str] | None = None
    for file in sorted(filter(is_image, folder.iterdir())):
        match = NUMBERED.fullmatch(stem(file))
        if match is None:
            raise InputError(
                f"{file}: no number in its name; expected that of the frame, or another folder for it"
            )
        series = series or (match[1], match[3])
        if (match[1], match[3]) != series:
            raise InputError(
                f"{file}: expected a name {series[0]}<number>{series[1]} as of the other frames; "
                "two series in one folder: give each its own"
            )
        first = numbered.setdefault(int(match[2]), file)
        if first is not file:
            raise InputError(
                f"{file}: the number of frame {first.name}; expected another: remove one of the two"
            )
    _require_all(folder, sorted(numbered))
    return [numbered[number] for number in sorted(numbered)]


def _require_all(folder: Path, frames: list[int]) -> None:
    if not frames:
        raise InputError(f"{folder}: holds no images; expected a 3-D file for each frame: correct the path")
    missing = sorted(set(range(frames[0], frames[-1] + 1)) - set(frames))
    if missing:
        raise InputError(
            f"{folder}: frames {frames[0]} to {frames[-1]}, but {', '.join(map(str, missing[:5]))}"
            f"{' and more' if len(missing) > 5 else ''} missing; expected every number: export all frames"
        )


def _frame(file: Path) -> tuple[Grid, Floats]:
    image = load(file)
    if image.GetDimension() != 3 or image.GetNumberOfComponentsPerPixel() != 1:
        raise InputError(
            f"{file}: {image.GetDimension()}-D; expected one 3-D image of brightness for each frame"
        )
    return grid_of(image, file), numbers(image)
