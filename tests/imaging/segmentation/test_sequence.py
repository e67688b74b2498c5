"""Segmentations of a beat as images: bright, dark and intermediate voxels, followed by a mesh."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.surface import LabelledSurface
from heartfit.imaging.segmentation.stack import Segmentation
from heartfit.imaging.segmentation.surface import label_images, segment_surface
from heartfit.imaging.sequence import Grid, ImageSequence
from tests.imaging.segmentation.conftest import STEP, axes

TIMES = 0.1 * np.arange(8)


@pytest.fixture(scope="module")
def smaller(ventricles: LabelledSurface, grid: Grid) -> Segmentation:
    """Narrower by a tenth, its base a slice lower, as at end systole."""
    points = (ventricles.points @ axes()) * [0.9, 0.9, 1.0] - [0.0, 0.0, STEP]
    return segment_surface(replace(ventricles, points=points @ axes().T), grid)


@pytest.fixture(scope="module")
def images(segmentation: Segmentation, smaller: Segmentation) -> ImageSequence:
    return label_images([segmentation, *7 * [smaller]], TIMES, 0.8)


def volume(images: ImageSequence, frame: int) -> float:
    """Volume of the blood: voxels brighter than the mean of muscle and blood; the background is darker."""
    blood = float((images.voxels[frame] > 0.75).sum())
    return blood * float(np.prod(images.grid.spacing))


def test_blood_is_bright_where_it_was_segmented(images: ImageSequence, segmentation: Segmentation) -> None:
    cavities = segmentation.parts["lv_cavity"] | segmentation.parts["rv_cavity"]
    places = segmentation.grid.points(np.argwhere(cavities)[:, ::-1].astype(float))
    index = np.rint(images.grid.index(places)).astype(int)
    shown = images.voxels[0][index[:, 2], index[:, 1], index[:, 0]]
    assert np.median(shown) == 1.0
    assert (shown > 0.5).mean() > 0.95
    assert images.voxels.min() == 0.0
    assert images.voxels.max() == 1.0


def test_a_smaller_heart_holds_less_and_ends_a_slice_lower(images: ImageSequence) -> None:
    assert volume(images, 1) / volume(images, 0) == pytest.approx(0.81, rel=0.02)
    tops = [np.flatnonzero((images.voxels[frame] > 0.75).any(axis=(1, 2)))[-1] for frame in (0, 1)]
    assert (tops[0] - tops[1]) * images.grid.spacing[2] == pytest.approx(STEP, abs=2e-3)


def test_a_frame_that_cannot_be_used_is_named(segmentation: Segmentation) -> None:
    wall = segmentation.parts["lv_wall"].copy()
    wall[6, :, 40:] = False
    spoilt = Segmentation(segmentation.grid, {**segmentation.parts, "lv_wall": wall})
    with pytest.raises(InputError, match="frame 3: segmentation: in slice 6"):
        label_images([*3 * [segmentation], spoilt, *4 * [segmentation]], TIMES, 0.8)
