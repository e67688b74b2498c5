"""One image file in any format that SimpleITK knows, refused in one line when it is damaged."""

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.imaging.grid import Grid
from heartfit.io.image_bytes import require_own_voxels, require_whole
from heartfit.io.image_packing import require_undamaged
from heartfit.io.sums import require_as_written
from heartfit.io.text import require_file

SUFFIXES = (".nii.gz", ".nii", ".nrrd", ".nhdr", ".mha", ".mhd")
MILLIMETRE = 1e-3
LARGEST_TILT = 1e-6


def is_image(path: Path) -> bool:
    return path.name.endswith(SUFFIXES)


def stem(path: Path) -> str:
    """The name without its suffix, ".nii.gz" being one."""
    suffix = next((suffix for suffix in SUFFIXES if path.name.endswith(suffix)), "")
    return path.name.removesuffix(suffix)


def load(path: Path) -> sitk.Image:
    """The image; raises InputError if it is missing, damaged, cut off, or a NIfTI that says not where it lies."""
    require_file(path, f"an image ({', '.join(SUFFIXES)})")
    if not is_image(path):
        raise InputError(
            f"{path}: not a kind of image that is read; expected {', '.join(SUFFIXES)}: convert it"
        )
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
    """The voxels as float32, the last axis of the image first."""
    voxels: Floats = sitk.GetArrayFromImage(image).astype(np.float32, copy=False)
    return voxels


def grid_of(image: sitk.Image, where: Path) -> Grid:
    """Where the voxels lie; raises InputError naming the file, also if a fourth axis is not apart from them."""
    dimension = image.GetDimension()
    direction = np.array(image.GetDirection()).reshape(dimension, dimension)
    if (
        max(np.abs(direction[3:, :3]).max(initial=0.0), np.abs(direction[:3, 3:]).max(initial=0.0))
        > LARGEST_TILT
    ):
        raise InputError(
            f"{where}: its direction mixes space and time; expected time alone on the fourth axis"
        )
    i, j, k = image.GetSize()[:3]
    spacing, origin = (
        MILLIMETRE * np.array(of_axis[:3]) for of_axis in (image.GetSpacing(), image.GetOrigin())
    )
    try:
        return Grid((i, j, k), spacing, origin, direction[:3, :3])
    except InputError as fault:
        raise InputError(f"{where}: {fault}") from None


def reason(failure: RuntimeError) -> str:
    """The last line in which SimpleITK says what went wrong, without the place in its source.

    "Reason:" is left out: it is that of whatever the system refused last.
    """
    lines = [line for line in str(failure).splitlines() if line.strip() and not line.startswith("Reason:")]
    return re.sub(r"^.*ERROR: |\w+\(0x[0-9a-f]+\): ", "", lines[-1]).strip().rstrip(".")


@contextmanager
def quiet() -> Iterator[None]:
    """Keeps the libraries below SimpleITK, which write to the file descriptor, off the standard error."""
    saved, sink = os.dup(2), os.open(os.devnull, os.O_WRONLY)
    os.dup2(sink, 2)
    try:
        yield
    finally:
        os.dup2(saved, 2)
        os.close(sink)
        os.close(saved)
