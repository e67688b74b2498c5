"""The segmentations of a whole beat as images: blood bright, muscle dark, all else between, the same in every slice.

What registration has to guess of a real cine, noise, fat, papillary muscles, and what lies between slices, is said here
once. Above the plane of the valves nothing is heart; it lies half a slice above the last slice that shows the heart in
that frame, so it moves by whole slices.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.imaging.grid import Grid
from heartfit.imaging.sequence import ImageSequence
from heartfit.segmentation.box import Box
from heartfit.segmentation.labels import Segmentation
from heartfit.segmentation.stack import Stack
from heartfit.segmentation.surface import SHAPING
from heartfit.segmentation.wall import Levels, Shaping, levels_in

BLOOD, ELSEWHERE = 1.0, 0.5
"""Brightness; that of muscle is 0."""

EDGE = 2e-3
"""Distance, m, from a surface at which its two sides have their own brightness."""


def label_images(
    frames: Sequence[Segmentation], times: Floats, period: float, shaping: Shaping = SHAPING
) -> ImageSequence:
    """Images (p,h,v,u) of segmentations at the times (p,) s of a beat; the first is end diastole.

    Raises InputError, naming the frame, where its slices cannot be used.
    """
    stacks = _stacks(frames)
    valves = [shaping.base(stack, frames[0].grid) for stack in stacks]
    box = _box(stacks, frames[0].grid, max(valves), shaping)
    images = [
        _image(levels_in(replace(box, stack=stack), shaping), plane)
        for stack, plane in zip(stacks, valves, strict=True)
    ]
    return ImageSequence(box.image_grid(), np.array(images, np.float32), times, period)


def _stacks(frames: Sequence[Segmentation]) -> list[Stack]:
    """The slices of each frame, all numbered as in the first."""
    stacks = [Stack.of(frames[0])]
    for number, frame in enumerate(frames[1:], start=1):
        try:
            stacks.append(Stack.of(frame, stacks[0].step))
        except InputError as fault:
            raise InputError(f"frame {number}: {fault}") from None
    return stacks


def _box(stacks: Sequence[Stack], grid: Grid, top: float, shaping: Shaping) -> Box:
    """One box for all frames, somewhat higher than the valves ever are."""
    deepest = max(len(stack.heart) for stack in stacks)
    heart = np.zeros((deepest, *grid.shape[1:]), bool)
    for stack in stacks:
        heart[: len(stack.heart)] |= stack.heart
    whole = Stack({"heart": heart}, stacks[0].first, stacks[0].step)
    above = top - (deepest - 1) * float(grid.spacing[2])
    return Box.around(whole, grid, shaping.spacing, shaping.right_wall, above + 2.0 * EDGE)


def _image(levels: Levels, valves: float) -> Floats:
    """Brightness (h,v,u), which changes within EDGE of a surface."""
    below = _inside(levels.box.heights - valves)[:, None, None]
    blood = below * _inside(np.minimum(levels.left, levels.right))
    return ELSEWHERE * (1.0 - below * _inside(levels.outside)) + BLOOD * blood


def _inside(distance: Floats) -> Floats:
    return np.clip(0.5 - 0.5 * distance / EDGE, 0.0, 1.0)
