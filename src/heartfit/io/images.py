"""Image sequences of one beat: a 4-D file, a folder of frames or a DICOM cine in; a 4-D file out.

Files are in mm and, as NIfTI says, in s, ms or us; a file of JSON beside the images, of the same name, holds what they
cannot: {"period_s": 0.829, "times_s": [0.0, 0.033, ...]}.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.imaging.grid import Grid
from heartfit.imaging.sequence import ImageSequence
from heartfit.io.atomic import replacing
from heartfit.io.cine import read_cine
from heartfit.io.image_file import MILLIMETRE, grid_of, is_image, load, numbers
from heartfit.io.image_folder import read_frames
from heartfit.io.image_times import Timing, read_sidecar, settle, sidecar, write_sidecar

WRITTEN = (".nrrd", ".nii.gz", ".mha")
NIFTI_TIMES = 8, 16, 24
"""The codes of s, ms and us in xyzt_units, which SimpleITK turns into s."""


def read_images(
    path: Path,
    period: float | None = None,
    times: Sequence[float] | Floats | None = None,
    usual: float | None = None,
) -> ImageSequence:
    """The images of one beat at `path`: a 4-D file, a folder of numbered 3-D files, or a folder of DICOM files.

    period s and times (p,) s of the frames go before the sidecar's, which go before the images' own; where none of them
    says the period it is the usual one, if there is one. Raises InputError, in one line that names the file, for what
    is missing, damaged, incomplete, mixed or without times.
    """
    path = Path(path)
    grid, voxels, own = _read(path)
    said = Timing(period, times), read_sidecar(path), own, Timing(usual)
    times, period = settle(path, len(voxels), *said)
    try:
        return ImageSequence(grid, voxels, times, period)
    except InputError as fault:
        raise InputError(f"{path}: {fault}") from None


def write_images(path: Path, sequence: ImageSequence) -> None:
    """Write a 4-D .nrrd, .nii.gz or .mha and its sidecar, the same bytes for the same sequence.

    Voxels and times are read back exactly, where they lie to 1e-6 (NIfTI) or 1e-15 of a metre. Raises ValueError for
    another suffix.
    """
    path = Path(path)
    if not path.name.endswith(WRITTEN):
        raise ValueError(f"{path}: image sequences are written as {', '.join(WRITTEN)}")
    with replacing(sidecar(path)) as draft_of_times, replacing(path) as draft:
        write_sidecar(draft_of_times, sequence.times, sequence.period)
        sitk.WriteImage(_image(sequence), str(draft), useCompression=True)


def _read(path: Path) -> tuple[Grid, Floats, Timing]:
    """Where the voxels lie, the voxels, and what the images say of time."""
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
    said = Timing(count * step, np.arange(count) * step) if _knows_seconds(image) else Timing()
    return grid_of(image, path), numbers(image), said


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
