"""Labels that cannot be a heart are refused in one line."""

from dataclasses import replace
from itertools import product

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.imaging.segmentation.stack import Segmentation, Stack
from heartfit.imaging.segmentation.surface import wall_surface
from heartfit.imaging.segmentation.wall import require_upright


def spoilt(segmentation: Segmentation, **parts: np.ndarray) -> Segmentation:
    return Segmentation(segmentation.grid, {**segmentation.parts, **parts})


def test_only_the_unmirrored_orientation_of_a_heart_is_accepted(segmentation: Segmentation) -> None:
    for signs in product((1.0, -1.0), repeat=3):
        grid = segmentation.grid
        turned = Segmentation(
            replace(grid, origin=grid.origin * signs, direction=np.diag(signs) @ grid.direction),
            segmentation.parts,
        )
        if signs == (1.0, 1.0, 1.0):
            require_upright(Stack.from_segmentation(turned), turned)
        else:
            with pytest.raises(InputError, match="mirrored"):
                require_upright(Stack.from_segmentation(turned), turned)


def test_an_empty_or_missing_part_is_refused(segmentation: Segmentation) -> None:
    with pytest.raises(InputError, match=r"voxel.*rv_cavity"):
        spoilt(segmentation, rv_cavity=np.zeros(segmentation.grid.shape, bool))
    with pytest.raises(InputError, match=r"rv_cavity.*missing"):
        Segmentation(segmentation.grid, {name: segmentation.parts[name] for name in ("lv_cavity", "lv_wall")})


def test_stray_voxels_are_named(segmentation: Segmentation) -> None:
    stray = segmentation.parts["rv_cavity"].copy()
    stray[1, 2, 3] = True
    with pytest.raises(InputError, match=r"rv_cavity.*\b2\b.*\b1\b.*\(3, 2, 1\)"):
        wall_surface(spoilt(segmentation, rv_cavity=stray))


def test_a_missing_slice_is_refused(segmentation: Segmentation) -> None:
    cavity = segmentation.parts["lv_cavity"].copy()
    cavity[7] = False
    with pytest.raises(InputError, match=r"lv_cavity.*\b2\b|slice 7.*lv_cavity"):
        wall_surface(spoilt(segmentation, lv_cavity=cavity))


def test_too_few_slices_are_refused(segmentation: Segmentation) -> None:
    grid = segmentation.grid
    few = Segmentation(
        replace(grid, size=(*grid.size[:2], 3)),
        {name: mask[9:12] for name, mask in segmentation.parts.items()},
    )
    with pytest.raises(InputError, match=r"\b3\b.*\b4\b"):
        wall_surface(few)


def test_swapped_labels_are_refused(segmentation: Segmentation) -> None:
    left, right = segmentation.parts["lv_cavity"], segmentation.parts["rv_cavity"]
    with pytest.raises(InputError, match=r"correct the labels|do not touch wall|swapped"):
        wall_surface(spoilt(segmentation, lv_cavity=right, rv_cavity=left))


def test_a_left_ventricle_without_base_is_refused(segmentation: Segmentation) -> None:
    """Wall that closes above the cavity as below it: no slice shows the valves."""
    wall = segmentation.heart & ~segmentation.parts["rv_cavity"]
    cavity = segmentation.parts["lv_cavity"].copy()
    cavity[:] = False
    cavity[9:11] = segmentation.parts["lv_cavity"][9:11]
    with pytest.raises(InputError, match=r"\b2 slices"):
        wall_surface(spoilt(segmentation, lv_cavity=cavity, lv_wall=wall & ~cavity))
