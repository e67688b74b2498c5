"""DICOM cine: parallel slices, each imaged at several times of the beat, from one folder.

Slices are often series of their own, from breath-holds whose beats differ in length. A frame's time is therefore a
share of its own slice's beat, and the beat of the sequence is the mean over the slices.

Tags by DICOM PS3.6: trigger time (0018,1060) ms, nominal interval (0018,1062) ms, heart rate (0018,1088) per minute,
temporal position (0020,0100), study (0020,000D), series (0020,000E), frame of reference (0020,0052), slice thickness
(0018,0050), spacing between slices (0018,0088).
"""

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import SimpleITK as sitk

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.imaging.sequence import Grid
from heartfit.io.image_file import grid_of, numbers, quiet, reason, require_alike
from heartfit.io.image_times import LONGEST_GAP, Timing, require_no_gap

MILLISECOND, MINUTE = 1e-3, 60.0
TRIGGER, INTERVAL, RATE, POSITION = "0018|1060", "0018|1062", "0018|1088", "0020|0100"
STUDY, SERIES, FRAME_OF_REFERENCE = "0020|000d", "0020|000e", "0020|0052"
THICKNESS, STEP = "0018|0050", "0018|0088"


@dataclass(frozen=True, eq=False)
class DicomSlice:
    """One slice at one time: file, grid one voxel deep, brightness (j, i), and the tags that are not empty."""

    file: Path
    grid: Grid
    voxels: Floats
    tags: Mapping[str, str]

    def number(self, tag: str) -> float:
        """Number under a tag, NaN without the tag; raises InputError for a value that is not a number."""
        try:
            return float(self.tags.get(tag, "nan"))
        except ValueError:
            raise InputError(f"{self.file}: tag ({tag}) is {self.tags[tag]!r}; expected a number") from None

    @property
    def trigger(self) -> float:
        """Time after the trigger [s]; NaN if the file does not state it."""
        return MILLISECOND * self.number(TRIGGER)

    @property
    def beat(self) -> float:
        """Length of the beat [s]; NaN if the file does not state it."""
        interval, rate = self.number(INTERVAL), self.number(RATE)
        if interval > 0.0:
            return MILLISECOND * interval
        return MINUTE / rate if rate > 0.0 else np.nan


def read_picture(file: Path) -> DicomSlice:
    """Read one DICOM image; raises InputError for a damaged file and for several frames in one file."""
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
    stated = {key: value for key, value in tags.items() if value}
    return DicomSlice(file, grid_of(image, file), numbers(image)[0], stated)


SAME_HEIGHT = 1e-4
"""Largest distance along the normal between pictures of one slice [m]."""

SAME_STEP = 0.01
"""Largest relative difference between slice distances that counts as rounding."""

SAME_PHASE = 0.5
"""Largest allowed difference between the times of one frame in several slices, over the time between frames."""

Stack = list[list[DicomSlice]]


def read_cine(folder: Path) -> tuple[Grid, Floats, Timing]:
    """Read grid, voxels (p, k, j, i) and timing of the one stack of slices below a folder.

    Raises InputError that names file or slice for files that are not DICOM images, several studies or stacks, grids
    that differ, duplicate pictures, and missing frames or slices.
    """
    files = [file for file in sorted(folder.rglob("*")) if file.is_file() and _may_be_picture(file)]
    if not files:
        raise InputError(f"{folder}: holds no images; expected 3-D frames of a beat or a DICOM cine")
    pictures = [read_picture(file) for file in files]
    _require_one_stack(pictures)
    stack = [_in_time(pictures_of_slice) for pictures_of_slice in _slices(pictures)]
    _require_all_frames(stack)
    voxels = np.stack([[picture.voxels for picture in slice_] for slice_ in stack], axis=1)
    return _grid(folder, stack), voxels, _timing(stack)


def _may_be_picture(file: Path) -> bool:
    return not file.name.startswith(".") and file.name != "DICOMDIR"


def _normal(picture: DicomSlice) -> Floats:
    normal: Floats = picture.grid.direction[:, 2]
    return normal


def _require_one_stack(pictures: list[DicomSlice]) -> None:
    first = pictures[0]
    for picture in pictures[1:]:
        for tag, name in ((STUDY, "study"), (FRAME_OF_REFERENCE, "frame of reference")):
            if picture.tags.get(tag) != first.tags.get(tag):
                raise InputError(
                    f"{picture.file}: another {name} than {first.file.name}; expected one cine in a folder"
                )
        offset = picture.grid.origin - first.grid.origin
        beside = first.grid.origin + offset - (offset @ _normal(first)) * _normal(first)
        projected = Grid(picture.grid.size, picture.grid.spacing, beside, picture.grid.direction)
        require_alike(picture.file, projected, first.file, first.grid)


def _slices(pictures: list[DicomSlice]) -> Stack:
    """Group pictures into slices, ordered along the normal."""
    heights = np.array([picture.grid.origin @ _normal(pictures[0]) for picture in pictures])
    order = np.argsort(heights, kind="stable")
    slice_of = np.cumsum(np.diff(heights[order], prepend=heights[order[0]]) > SAME_HEIGHT)
    slices = defaultdict(list)
    for number, index in zip(slice_of, order, strict=True):
        slices[number].append(pictures[index])
    return list(slices.values())


def _in_time(pictures: list[DicomSlice]) -> list[DicomSlice]:
    """Order the pictures of one slice by trigger time or, where trigger times are not distinct, temporal position."""
    key = np.array([picture.trigger for picture in pictures])
    if np.isnan(key).any() or len(np.unique(key)) < len(key):
        key = np.array([picture.number(POSITION) for picture in pictures])
    if np.isnan(key).any():
        unknown = pictures[int(np.argmax(np.isnan(key)))].file
        raise InputError(
            f"{unknown}: no trigger time and no temporal position of its own; expected the frames of one beat"
        )
    order = np.argsort(key, kind="stable")
    twice = np.flatnonzero(np.diff(key[order]) == 0.0)
    if len(twice):
        one, other = (pictures[order[twice[0] + step]] for step in (0, 1))
        series = "two series are mixed" if one.tags.get(SERIES) != other.tags.get(SERIES) else "one is a copy"
        raise InputError(
            f"{other.file}: same place and time as {one.file.name}; {series}: keep one of the two"
        )
    ordered = [pictures[index] for index in order]
    require_no_gap(_slice_name(ordered), key[order])
    return ordered


def _require_all_frames(stack: Stack) -> None:
    most = max(map(len, stack))
    short = next((slice_ for slice_ in stack if len(slice_) < most), None)
    if short:
        raise InputError(
            f"{_slice_name(short)}: {len(short)} frames, other slices have {most}; export all of them"
        )


def _slice_name(pictures: list[DicomSlice]) -> str:
    place = ", ".join(f"{1e3 * value:.1f}" for value in pictures[0].grid.origin)
    return f"{pictures[0].file.parent}: slice at ({place}) mm"


def _grid(folder: Path, stack: Stack) -> Grid:
    """Grid of all slices; the third direction is the normal of the slices, along which they are ordered."""
    first = stack[0][0].grid
    step = first.spacing[2] if len(stack) == 1 else _step(stack)
    if len(stack) == 1 and not {THICKNESS, STEP} & set(stack[0][0].tags):
        raise InputError(
            f"{folder}: one slice of unknown thickness; expected the tag ({THICKNESS}); export it again"
        )
    i, j, _ = first.size
    return Grid((i, j, len(stack)), np.array([*first.spacing[:2], step]), first.origin, first.direction)


def _step(stack: Stack) -> float:
    """Distance between slices [m]."""
    heights = np.array([slice_[0].grid.origin @ _normal(stack[0][0]) for slice_ in stack])
    steps = np.diff(heights)
    usual = float(np.median(steps))
    wrong = int(np.abs(steps - usual).argmax())
    if abs(steps[wrong] - usual) > SAME_STEP * usual:
        cure = "a slice is missing" if steps[wrong] > LONGEST_GAP * usual else "two stacks are mixed"
        raise InputError(
            f"{_slice_name(stack[wrong])}: the next slice is {1e3 * steps[wrong]:.1f} mm away, the others "
            f"{1e3 * usual:.1f} mm; {cure}: export one stack with all slices"
        )
    return float(steps.mean())


def _timing(stack: Stack) -> Timing:
    """Mean beat and mean frame times of the slices; None where tags are missing."""
    beats = np.array([[picture.beat for picture in slice_] for slice_ in stack]).mean(axis=1)
    triggers = np.array([[picture.trigger for picture in slice_] for slice_ in stack])
    period = None if np.isnan(beats).any() else float(beats.mean())
    if np.isnan(triggers).any() or not (np.diff(triggers) > 0.0).all():
        return Timing(period)
    times = triggers if period is None else triggers * (period / beats[:, None])
    mean = times.mean(axis=0)
    shift = np.abs(times - mean).max(axis=1)
    if shift.max() > SAME_PHASE * np.diff(mean).mean():
        raise InputError(
            f"{_slice_name(stack[int(shift.argmax())])}: frames {1e3 * shift.max():.0f} ms off those of other slices; "
            "expected the same phases of the beat in every slice"
        )
    return Timing(period, mean)
