"""The short-axis slices that are used: from the apex to the last one below the valves."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from scipy.ndimage import label

from heartfit.errors import InputError
from heartfit.geometry.arrays import Floats
from heartfit.segmentation.labels import Mask, Segmentation

P = TypeVar("P", int, Floats)

FEWEST_SLICES = 4
"""Slices with a left cavity inside a ring of wall, below which too much of the shape is guessed."""

OPEN = 0.5
"""Share of the left cavity's outline in a slice that may touch what is no wall: the first slice above is left out, as
readers do (Schulz-Menger et al. 2020, doi 10.1186/s12968-020-00610-6)."""

HOLE = 0.1
"""The same in the lower half of the slices, where no valve is."""

SMALLEST_RIGHT = 0.1
"""Area of the right cavity, over the left one's, with which a slice can be the last."""


@dataclass(frozen=True, eq=False)
class Stack:
    """Masks (k,j,i) by name from the apical end to the base.

    first: number in the images of the slice at the apical end; step: 1 if numbers grow towards the base, else -1.
    """

    parts: Mapping[str, Mask]
    first: int
    step: int

    @classmethod
    def of(cls, segmentation: Segmentation, step: int | None = None) -> "Stack":
        """The slices up to the highest one in which wall surrounds the left cavity and the right cavity is seen.

        Above it lie valves and outflow tracts. step: as below, or found from the heart, which widens towards the base;
        at end systole it may not. Raises InputError for holes in the wall, parts that skip a slice and
        fewer than FEWEST_SLICES.
        """
        step = step or _towards_base(segmentation.heart)
        whole = cls(
            {name: mask[::step] for name, mask in segmentation.parts.items()},
            0 if step == 1 else segmentation.grid.shape[0] - 1,
            step,
        )
        ring = whole.rings()
        _require_slices(int(ring.sum()))
        base = int(np.flatnonzero(ring)[-1])
        below = {name: mask[: base + 1] for name, mask in whole.parts.items()}
        stack = cls(below | {"rv_cavity": _one_opening(below["rv_cavity"])}, whole.first, step)
        stack._require_whole()
        return stack

    @property
    def left(self) -> Mask:
        """The left ventricle, cavity and wall."""
        return self.parts["lv_cavity"] | self.parts["lv_wall"]

    @property
    def heart(self) -> Mask:
        """All that is labelled."""
        heart: Mask = np.logical_or.reduce(list(self.parts.values()))
        return heart

    def number(self, place: P) -> P:
        """The number in the images of a slice, or of places between slices, counted from the apical end."""
        return self.first + self.step * place

    def rings(self) -> Mask:
        """Whether each slice (k,) shows the right cavity, and the left one with wall around it."""
        both = zip(self.parts["lv_cavity"], self.left, self.parts["rv_cavity"], strict=True)
        return np.array(
            [
                right.sum() > SMALLEST_RIGHT * cavity.sum() > 0.0 and _open(cavity, left) < OPEN
                for cavity, left, right in both
            ]
        )

    def _require_whole(self) -> None:
        for name in ("lv_cavity", "rv_cavity"):
            skipped = np.flatnonzero(areas(self.parts[name])[lowest(self.parts[name]) :] == 0.0)
            if len(skipped):
                raise InputError(
                    f"segmentation: slice {self.number(lowest(self.parts[name]) + int(skipped[0]))} has no {name}, "
                    "slices on either side have; expected it in every slice between: segment that slice too"
                )
        for k, (cavity, left) in enumerate(zip(self.parts["lv_cavity"], self.left, strict=True)):
            if _open(cavity, left) > (HOLE if 2 * k < len(self.heart) else OPEN):
                raise InputError(
                    f"segmentation: in slice {self.number(k)}, {100 * _open(cavity, left):.0f} % of the left cavity's "
                    "outline touch what is no wall; expected wall around it: close the ring"
                )


def _one_opening(cavity: Mask) -> Mask:
    """The right cavity without the smaller pieces of its last slices, where inflow and outflow part.

    A wall with two openings into one cavity has a bar between them, too thin to be filled with tetrahedra.
    """
    kept = cavity.copy()
    for k in range(len(cavity) - 1, -1, -1):
        pieces, count = label(cavity[k])
        if count < 2:
            break
        kept[k] = pieces == 1 + np.bincount(pieces.ravel())[1:].argmax()
    return kept


def _towards_base(heart: Mask) -> int:
    """1 if the heart widens along k, else -1."""
    seen = areas(heart)
    centre = float(np.flatnonzero(seen).mean())
    return 1 if float(((np.arange(len(seen)) - centre) * seen).sum()) >= 0.0 else -1


def _open(cavity: Mask, closed: Mask) -> float:
    """Share of the sides of a cavity's pixels (j,i) towards others that face what shall not be there."""
    framed, enclosed = np.pad(cavity, 1), np.pad(closed, 1)
    outline = [np.roll(framed, step, axis) & ~framed for axis in (0, 1) for step in (1, -1)]
    touching = sum(int((side & ~enclosed).sum()) for side in outline)
    return touching / max(sum(int(side.sum()) for side in outline), 1)


def _require_slices(count: int) -> None:
    if count < FEWEST_SLICES:
        raise InputError(
            f"segmentation: {count} slices show the right cavity, and the left one with wall around it; expected at "
            f"least {FEWEST_SLICES}: segment more slices between apex and valves, or state the labels anew"
        )


def lowest(mask: Mask) -> int:
    """The first slice that shows a part."""
    return int(mask.any(axis=(1, 2)).argmax())


def areas(mask: Mask) -> Floats:
    """Pixels (k,) of a part in each slice."""
    return mask.sum(axis=(1, 2)).astype(float)
