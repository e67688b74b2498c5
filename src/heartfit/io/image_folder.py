"""A folder with one 3-D image for each frame of the beat."""

import re
from pathlib import Path

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.imaging.grid import Grid
from heartfit.io.image_file import grid_of, is_image, load, numbers, stem

NUMBERED = re.compile(r"(.*?)(\d+)(\D*)")
SAME_SPACING, SAME_DIRECTION, SAME_PLACE = 1e-4, 1e-3, 1e-4
"""Relative; cosines; m. What NIfTI and DICOM round off is less."""


def read_frames(folder: Path) -> tuple[Grid, Floats]:
    """Grid and voxels (p,k,j,i) of the frames in the order of the last number in their names.

    Raises InputError naming the file that has no number or one that is taken, belongs to another series, is not 3-D,
    or lies otherwise than the first; and for numbers that skip.
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
    """Raises InputError if two files have not the same box of voxels."""
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
    wrong = next((what for what, same in alike.items() if not same), None)
    if wrong:
        raise InputError(f"{file}: {wrong} as in {first.name}; every image must have the same box of voxels")


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
        taken = numbered.setdefault(int(match[2]), file)
        if taken is not file:
            raise InputError(
                f"{file}: the number of frame {taken.name}; expected another: remove one of the two"
            )
    _require_all(folder, sorted(numbered))
    return [numbered[number] for number in sorted(numbered)]


def _require_all(folder: Path, found: list[int]) -> None:
    if not found:
        raise InputError(f"{folder}: holds no images; expected a 3-D file for each frame: correct the path")
    missing = sorted(set(range(found[0], found[-1] + 1)) - set(found))
    if missing:
        raise InputError(
            f"{folder}: frames {found[0]} to {found[-1]}, but {', '.join(map(str, missing[:5]))}"
            f"{' and more' if len(missing) > 5 else ''} missing; expected every number: export all frames"
        )


def _frame(file: Path) -> tuple[Grid, Floats]:
    image = load(file)
    if image.GetDimension() != 3 or image.GetNumberOfComponentsPerPixel() != 1:
        raise InputError(
            f"{file}: {image.GetDimension()}-D; expected one 3-D image of brightness for each frame"
        )
    return grid_of(image, file), numbers(image)
