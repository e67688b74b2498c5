"""Image sequences of one beat: read from a 4-D file, a folder of frames or a DICOM cine; written as a 4-D file.

Files are in mm and, as NIfTI states, in s, ms or us. A JSON file of the same name next to the images holds the exact
times: {"period_s": 0.829, "times_s": [0.0, 0.033, ...]}.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.io.cine import read_cine
from heartfit.io.files import replacing
from heartfit.io.image_file import MILLIMETRE, grid_of, load, numbers, read_frames
from heartfit.io.image_names import is_image
from heartfit.io.image_times import Timing, read_sidecar, settle, sidecar, write_sidecar
from heartfit.io.jitter import moved_voxels

WRITTEN = (".nrrd", ".nii.gz", ".mha")
NIFTI_TIMES = 8, 16, 24
"""Codes of s, ms and us in xyzt_units; SimpleITK converts all of them to s."""


def read_images(
    path: Path,
    period: float | None = None,
    times: Sequence[float] | Floats | None = None,
    usual: float | None = None,
) -> ImageSequence:
    """Read the images of one beat: a 4-D file, a folder of numbered 3-D files, or a folder of DICOM files.

    The arguments period [s] and times (p,) [s] precede those of the sidecar, which precede those of the images; without
    any period the usual one holds, if there is one. Raises InputError, in one line that names the file, for images that
    are missing, damaged, incomplete, mixed or without times.
    """
    path = Path(path)
    grid, voxels, own = _read(path)
    sources = Timing(period, times), read_sidecar(path), own, Timing(usual)
    times, period = settle(path, len(voxels), *sources)
    try:
        return ImageSequence(grid, moved_voxels(voxels), times, period)
    except InputError as fault:
        raise InputError(f"{path}: {fault}") from None


def write_images(path: Path, sequence: ImageSequence) -> None:
    """Write a 4-D .nrrd, .nii.gz or .mha and its sidecar, the same bytes for the same sequence.

    Voxels and times are read back exactly, positions to 1e-6 m (NIfTI) or 1e-15 m. Raises ValueError for another
    suffix.
    """
    path = Path(path)
    if not path.name.endswith(WRITTEN):
        raise ValueError(f"{path}: image sequences are written as {', '.join(WRITTEN)}")
    with replacing(sidecar(path)) as draft_of_times, replacing(path) as draft:
        write_sidecar(draft_of_times, sequence.times, sequence.period)
        sitk.WriteImage(_image(sequence), str(draft), useCompression=True)


def _read(path: Path) -> tuple[Grid, Floats, Timing]:
    """Grid, voxels and the timing that the images state."""
    if not path.is_dir():
        return _read_file(path)
    if any(map(is_image, path.iterdir())):
        return *read_frames(path), Timing()
    return read_cine(path)


def _read_file(path: Path) -> tuple[Grid, Floats, Timing]:
    image = load(path)
    if image.GetDimension() != 4 or image.GetNumberOfComponentsPerPixel() != 1:
        raise InputError(
            f"{path}: {image.GetDimension()}-D, numbers in a voxel {image.GetNumberOfComponentsPerPixel()}; expected "
            "4-D, time last, one number in a voxel, or a folder with one 3-D image for each frame"
        )
    count, step = image.GetSize()[3], image.GetSpacing()[3]
    timing = Timing(count * step, np.arange(count) * step) if _knows_seconds(image) else Timing()
    return grid_of(image, path), numbers(image), timing


def _knows_seconds(image: sitk.Image) -> bool:
    key = "xyzt_units"
    return image.HasMetaDataKey(key) and int(image.GetMetaData(key)) & 0x38 in NIFTI_TIMES


def _image(sequence: ImageSequence) -> sitk.Image:
    grid = sequence.grid
    image = sitk.GetImageFromArray(sequence.voxels.astype(np.float32, copy=False), isVector=False)
    direction = np.eye(4)
    direction[:3, :3] = grid.direction
    image.SetSpacing([*(grid.spacing / MILLIMETRE), float(np.median(np.diff(sequence.times)))])
    image.SetOrigin([*(grid.origin / MILLIMETRE), 0.0])
    image.SetDirection(direction.ravel().tolist())
    return image
