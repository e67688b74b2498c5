"""A DICOM cine: parallel slices, each at several times of the beat, from one folder.

Slices are often series of their own, from breath-holds whose beats differ in length. So a frame's time is its share of
its own slice's beat, and the sequence's beat is the slices' mean.
"""

from collections import defaultdict
from pathlib import Path

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.imaging.grid import Grid
from heartfit.io.dicom import (
    FRAME_OF_REFERENCE,
    POSITION,
    SERIES,
    STEP,
    STUDY,
    THICKNESS,
    Picture,
    read_picture,
)
from heartfit.io.image_folder import require_alike
from heartfit.io.image_times import LONGEST_GAP, Timing, require_no_gap

SAME_HEIGHT = 1e-4
"""Pictures nearer to each other along the normal, m, are of one slice."""

SAME_STEP = 0.01
"""Differences in the distances of slices, relative, that are taken for rounding."""

SAME_PHASE = 0.5
"""Differences in the times of one frame in several slices, over the time between frames, that are let pass."""

Stack = list[list[Picture]]


def read_cine(folder: Path) -> tuple[Grid, Floats, Timing]:
    """Grid, voxels (p,k,j,i) and times of the one stack of slices in a folder and the folders in it.

    Raises InputError naming file or slice for what is no DICOM image, several studies or stacks, boxes of voxels that
    differ, pictures that are there twice, and missing frames or slices.
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


def _normal(picture: Picture) -> Floats:
    normal: Floats = picture.grid.direction[:, 2]
    return normal


def _require_one_stack(pictures: list[Picture]) -> None:
    first = pictures[0]
    for picture in pictures[1:]:
        for tag, what in ((STUDY, "study"), (FRAME_OF_REFERENCE, "frame of reference")):
            if picture.tags.get(tag) != first.tags.get(tag):
                raise InputError(
                    f"{picture.file}: another {what} than {first.file.name}; expected one cine in a folder"
                )
        offset = picture.grid.origin - first.grid.origin
        beside = first.grid.origin + offset - (offset @ _normal(first)) * _normal(first)
        moved = Grid(picture.grid.size, picture.grid.spacing, beside, picture.grid.direction)
        require_alike(picture.file, moved, first.file, first.grid)


def _slices(pictures: list[Picture]) -> Stack:
    """The pictures of each slice, along the normal."""
    heights = np.array([picture.grid.origin @ _normal(pictures[0]) for picture in pictures])
    order = np.argsort(heights, kind="stable")
    slice_of = np.cumsum(np.diff(heights[order], prepend=heights[order[0]]) > SAME_HEIGHT)
    slices = defaultdict(list)
    for number, index in zip(slice_of, order, strict=True):
        slices[number].append(pictures[index])
    return list(slices.values())


def _in_time(pictures: list[Picture]) -> list[Picture]:
    """The pictures of one slice by trigger time or, where these do not tell them apart, temporal position."""
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


def _slice_name(pictures: list[Picture]) -> str:
    place = ", ".join(f"{1e3 * value:.1f}" for value in pictures[0].grid.origin)
    return f"{pictures[0].file.parent}: slice at ({place}) mm"


def _grid(folder: Path, stack: Stack) -> Grid:
    """The box of all slices; the third direction is that of the slices' normal, along which they are ordered."""
    first = stack[0][0].grid
    step = first.spacing[2] if len(stack) == 1 else _step(stack)
    if len(stack) == 1 and not {THICKNESS, STEP} & set(stack[0][0].tags):
        raise InputError(
            f"{folder}: one slice of unknown thickness; expected the tag ({THICKNESS}); export it again"
        )
    i, j, _ = first.size
    return Grid((i, j, len(stack)), np.array([*first.spacing[:2], step]), first.origin, first.direction)


def _step(stack: Stack) -> float:
    """The distance in m between slices."""
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
    """The slices' mean beat and mean times; nothing where the tags say nothing."""
    beats = np.array([[picture.beat for picture in slice_] for slice_ in stack]).mean(axis=1)
    triggers = np.array([[picture.trigger for picture in slice_] for slice_ in stack])
    period = None if np.isnan(beats).any() else float(beats.mean())
    if np.isnan(triggers).any() or not (np.diff(triggers) > 0.0).all():
        return Timing(period)
    times = triggers if period is None else triggers * (period / beats[:, None])
    mean = times.mean(axis=0)
    apart = np.abs(times - mean).max(axis=1)
    if apart.max() > SAME_PHASE * np.diff(mean).mean():
        raise InputError(
            f"{_slice_name(stack[int(apart.argmax())])}: frames {1e3 * apart.max():.0f} ms off those of other slices; "
            "expected the same phases of the beat in every slice"
        )
    return Timing(period, mean)
