"""One image of a DICOM series, with the tags that place it in a beat.

By DICOM PS3.6: trigger time (0018,1060) ms, nominal interval (0018,1062) ms, heart rate (0018,1088) per minute,
temporal position (0020,0100), study (0020,000D), series (0020,000E), frame of reference (0020,0052), slice thickness
(0018,0050), spacing between slices (0018,0088).
"""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.imaging.grid import Grid
from heartfit.io.image_file import grid_of, numbers, quiet, reason

MILLISECOND, MINUTE = 1e-3, 60.0
TRIGGER, INTERVAL, RATE, POSITION = "0018|1060", "0018|1062", "0018|1088", "0020|0100"
STUDY, SERIES, FRAME_OF_REFERENCE = "0020|000d", "0020|000e", "0020|0052"
THICKNESS, STEP = "0018|0050", "0018|0088"


@dataclass(frozen=True, eq=False)
class Picture:
    """One slice at one time: its file, its box of voxels one voxel deep, brightness (j,i), tags that are not empty."""

    file: Path
    grid: Grid
    voxels: Floats
    tags: Mapping[str, str]

    def number(self, tag: str) -> float:
        """The number under a tag; NaN if there is none. Raises InputError if it is something else."""
        try:
            return float(self.tags.get(tag, "nan"))
        except ValueError:
            raise InputError(f"{self.file}: tag ({tag}) is {self.tags[tag]!r}; expected a number") from None

    @property
    def trigger(self) -> float:
        """Time in s after the trigger; NaN if the file does not say."""
        return MILLISECOND * self.number(TRIGGER)

    @property
    def beat(self) -> float:
        """Length of the beat in s; NaN if the file does not say."""
        interval, rate = self.number(INTERVAL), self.number(RATE)
        if interval > 0.0:
            return MILLISECOND * interval
        return MINUTE / rate if rate > 0.0 else np.nan


def read_picture(file: Path) -> Picture:
    """Raises InputError for what is no sound DICOM image or holds several frames."""
    reader = sitk.ImageFileReader()
    reader.SetImageIO("GDCMImageIO")
    reader.SetFileName(str(file))
    try:
        with quiet():
            image = reader.Execute()
    except RuntimeError as failure:
        raise InputError(
            f"{file}: not a sound DICOM image: {reason(failure)}; export it again or remove it"
        ) from None
    if image.GetSize()[2:] != (1,) or image.GetNumberOfComponentsPerPixel() != 1:
        raise InputError(
            f"{file}: {image.GetSize()} pixels; expected one grey slice: export single frames, or convert to NIfTI"
        )
    tags = {key: image.GetMetaData(key).strip() for key in image.GetMetaDataKeys()}
    told = {key: value for key, value in tags.items() if value}
    return Picture(file, grid_of(image, file), numbers(image)[0], told)
