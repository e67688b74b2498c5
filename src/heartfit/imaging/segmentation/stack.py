"""Segmented images of one moment, and the stack of their slices from apex to base."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.imaging.sequence import Grid

Mask = NDArray[np.bool_]
Place = TypeVar("Place", int, Floats)

REQUIRED_PARTS = ("lv_cavity", "lv_wall", "rv_cavity")
PARTS = (*REQUIRED_PARTS, "rv_wall")
MIN_SLICES = 4
"""Fewest slices with a left cavity inside a ring of wall; with fewer, too much of the shape is guessed."""
MAX_OPEN_SHARE = 0.5
"""Largest share of the outline of the left cavity in a slice that may touch other voxels than wall: the first slice
beyond it is left out, as readers do (Schulz-Menger et al. 2020, doi 10.1186/s12968-020-00610-6)."""
MAX_HOLE_SHARE = 0.1
"""The same share in the lower half of the slices, below the valves."""
MIN_RIGHT_AREA_RATIO = 0.1
"""Smallest area of the right cavity, over the left one, in the last slice."""


@dataclass(frozen=True, eq=False)
class Segmentation:
    """Labelled voxels of one moment of the beat.

    grid: position of the voxels, its third axis across the short-axis slices; parts: name in PARTS -> mask (k, j, i);
    rv_wall may be missing, as the wall of the right ventricle often is. Papillary muscles count as the part that they
    are labelled as. Raises InputError for a part that is missing, empty or of another shape.
    """

    grid: Grid
    parts: Mapping[str, Mask]

    def __post_init__(self) -> None:
        for name in REQUIRED_PARTS:
            if name not in self.parts:
                raise InputError(f"segmentation: {name} is missing; expected {', '.join(REQUIRED_PARTS)}")
        for name, mask in self.parts.items():
            if mask.shape != self.grid.shape:
                raise InputError(
                    f"segmentation: {name} has voxels {mask.shape}, expected {self.grid.shape} (k, j, i)"
                )
            if not mask.any():
                raise InputError(
                    f"segmentation: no voxel is labelled {name}; expected some: correct the label of that part"
                )

    @property
    def heart(self) -> Mask:
        """All labelled voxels."""
        whole: Mask = np.logical_or.reduce(list(self.parts.values()))
        return whole


@dataclass(frozen=True, eq=False)
class Stack:
    """Masks (k, j, i) by name from the apical end to the base.

    first: number in the images of the slice at the apical end; step: 1 if numbers increase towards the base, else -1.
    """

    parts: Mapping[str, Mask]
    first: int
    step: int

    @classmethod
    def from_segmentation(cls, segmentation: Segmentation, step: int | None = None) -> "Stack":
        """Take the slices up to the highest one that shows the right cavity, and wall around the left cavity.

        Above it lie valves and outflow tracts. step: 1 or -1; if None it is derived from the heart, which widens
        towards the base (at end systole it may not). Raises InputError for holes in the wall, parts that skip a slice
        and fewer than MIN_SLICES slices.
        """
        step = step or _direction_to_base(segmentation.heart)
        whole = cls(
            {name: mask[::step] for name, mask in segmentation.parts.items()},
            0 if step == 1 else segmentation.grid.shape[0] - 1,
            step,
        )
        ring = whole.rings()
        _require_slices(int(ring.sum()))
        base = int(np.flatnonzero(ring)[-1])
        below = {name: mask[: base + 1] for name, mask in whole.parts.items()}
        stack = cls(below | {"rv_cavity": _keep_largest_pieces(below["rv_cavity"])}, whole.first, step)
        stack._require_whole()
        return stack

    @property
    def left(self) -> Mask:
        """Left ventricle: cavity and wall."""
        return self.parts["lv_cavity"] | self.parts["lv_wall"]

    @property
    def heart(self) -> Mask:
        """All labelled voxels."""
        heart: Mask = np.logical_or.reduce(list(self.parts.values()))
        return heart

    def number(self, place: Place) -> Place:
        """Number in the images of a slice, or a position between slices, counted from the apical end."""
        return self.first + self.step * place

    def rings(self) -> Mask:
        """Mask (k,) of the slices that show the right cavity, and the left cavity with wall around it."""
        slices = zip(self.parts["lv_cavity"], self.left, self.parts["rv_cavity"], strict=True)
        return np.array(
            [
                right.sum() > MIN_RIGHT_AREA_RATIO * cavity.sum() > 0.0
                and _open_share(cavity, left) < MAX_OPEN_SHARE
                for cavity, left, right in slices
            ]
        )

    def _require_whole(self) -> None:
        for name in ("lv_cavity", "rv_cavity"):
            skipped = np.flatnonzero(areas(self.parts[name])[lowest(self.parts[name]) :] == 0.0)
            if len(skipped):
                raise InputError(
                    f"segmentation: slice {self.number(lowest(self.parts[name]) + int(skipped[0]))} has no {name}, "
                    "but slices on either side have; expected it in every slice between: segment that slice too"
                )
        for k, (cavity, left) in enumerate(zip(self.parts["lv_cavity"], self.left, strict=True)):
            if _open_share(cavity, left) > (MAX_HOLE_SHARE if 2 * k < len(self.heart) else MAX_OPEN_SHARE):
                raise InputError(
                    f"segmentation: in slice {self.number(k)}, {100 * _open_share(cavity, left):.0f} % of the outline "
                    "of the left cavity do not touch wall; expected wall around it: close the ring"
                )


def _keep_largest_pieces(cavity: Mask) -> Mask:
    """Return the right cavity without the smaller pieces of its last slices, where inflow and outflow divide.

    A wall with two openings into one cavity has a bar between them, too thin to be filled with tetrahedra.
    """
    kept = cavity.copy()
    for k in range(len(cavity) - 1, -1, -1):
        pieces, count = label(cavity[k])
        if count < 2:
            break
        kept[k] = pieces == 1 + np.bincount(pieces.ravel())[1:].argmax()
    return kept


def _direction_to_base(heart: Mask) -> int:
    """Return 1 if the heart widens along k, else -1."""
    sizes = areas(heart)
    centre = float(np.flatnonzero(sizes).mean())
    return 1 if float(((np.arange(len(sizes)) - centre) * sizes).sum()) >= 0.0 else -1


def _open_share(cavity: Mask, closed: Mask) -> float:
    """Share of the outline of a cavity (j, i), in sides of pixels, that faces pixels outside ``closed`` (j, i)."""
    framed, enclosed = np.pad(cavity, 1), np.pad(closed, 1)
    outline = [np.roll(framed, step, axis) & ~framed for axis in (0, 1) for step in (1, -1)]
    touching = sum(int((side & ~enclosed).sum()) for side in outline)
    return touching / max(sum(int(side.sum()) for side in outline), 1)


def _require_slices(count: int) -> None:
    if count < MIN_SLICES:
        raise InputError(
            f"segmentation: {count} slices show the right cavity, and the left one with wall around it; expected at "
            f"least {MIN_SLICES}: segment more slices between apex and valves, or correct the labels"
        )


def lowest(mask: Mask) -> int:
    """Return the first slice that shows a part."""
    return int(mask.any(axis=(1, 2)).argmax())


def areas(mask: Mask) -> Floats:
    """Number of pixels (k,) of a part in each slice."""
    return mask.sum(axis=(1, 2)).astype(float)
