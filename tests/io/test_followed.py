"""Images for the registration of a segmented heart."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.parametric import ParametricVentricles
from heartfit.geometry.surface import LabelledSurface
from heartfit.imaging.segmentation.stack import Segmentation
from heartfit.imaging.segmentation.surface import segment_surface
from heartfit.imaging.sequence import Grid, ImageSequence
from heartfit.io.segmentations import sequence_to_track, write_segmentation
from heartfit.study.case import Labels, Source

LABELS = Labels(lv_cavity=1, lv_wall=2, rv_cavity=3)
DIRECTION = np.array([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0]])
"""Slices across the axis of a heart that stands upright, its right ventricle to the right."""


@pytest.fixture(scope="module")
def heart() -> tuple[Grid, Segmentation, Segmentation]:
    """A grid of images, and a heart in it that is large, then small."""
    wall = ParametricVentricles(150e-6, 10e-3, 1.8, 160e-6, 3.5e-3).surface()
    grid = Grid((70, 60, 15), np.array([2e-3, 2e-3, 8e-3]), np.array([0.055, 0.06, -0.108]), DIRECTION)
    surfaces = (
        LabelledSurface(wall.points @ DIRECTION * scale, wall.triangles, wall.labels) for scale in (1.0, 0.9)
    )
    large, small = (segment_surface(surface, grid) for surface in surfaces)
    return grid, large, small


@pytest.fixture
def cine(heart: tuple[Grid, Segmentation, Segmentation]) -> ImageSequence:
    noise = np.random.default_rng(0).random((8, *heart[0].shape)).astype(np.float32)
    return ImageSequence(heart[0], noise, 0.1 * np.arange(8), 0.8)


def source(folder: Path, frames: Sequence[Segmentation], end_diastole: int = 0) -> Source:
    file = folder / "drawn.nrrd"
    write_segmentation(file, frames, LABELS.numbers())
    return Source(segmentation=str(file), labels=LABELS, images="cine", end_diastole=end_diastole)


def test_end_diastole_alone_leaves_the_cine(
    tmp_path: Path, heart: tuple[Grid, Segmentation, Segmentation], cine: ImageSequence
) -> None:
    assert sequence_to_track(source(tmp_path, heart[1:2]), cine) is cine


def test_labels_of_every_frame_take_its_place_end_diastole_first(
    tmp_path: Path, heart: tuple[Grid, Segmentation, Segmentation], cine: ImageSequence
) -> None:
    _, large, small = heart
    images = sequence_to_track(source(tmp_path, [small, large, *6 * [small]], end_diastole=1), cine)
    blood = (images.voxels > 0.75).sum(axis=(1, 2, 3))
    assert blood.argmax() == 0
    assert len(set(blood[1:].tolist())) == 1
    assert np.array_equal(images.times, cine.times)


def test_frames_that_differ_from_the_cine_are_refused(
    tmp_path: Path, heart: tuple[Grid, Segmentation, Segmentation], cine: ImageSequence
) -> None:
    with pytest.raises(InputError, match="5 frames, the images have 8"):
        sequence_to_track(source(tmp_path, 5 * [heart[1]]), cine)
