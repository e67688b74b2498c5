"""A bright disc that beats in its plane is followed; points elsewhere and folds are refused by name."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.imaging.registration.slices import Demons, SliceMotion, register_slices, require_unfolded
from heartfit.imaging.sequence import Grid, ImageSequence

FRAMES, PIXEL, STEP = 8, 1.5e-3, 15e-3
AXES = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
GRID = Grid((84, 80, 2), np.array([PIXEL, PIXEL, STEP]), np.array([0.01, -0.02, 0.03]), AXES)
CENTRE, RADIUS = np.array([43.0, 38.0]), np.array([20.0, 16.0])
WALL = 6.0
PHASE = 2.0 * np.pi * np.arange(FRAMES) / FRAMES
SIZE = 1.0 - 0.15 * (1.0 - np.cos(PHASE))
SHIFT = np.stack([1.0 - np.cos(PHASE), np.sin(PHASE)], axis=1)
"""Radii relative to the first frame, and displacement of the centre in pixels."""


def beating_discs(slices: int = 2) -> ImageSequence:
    """Blood in a ring of muscle that keeps its area, in air; edges take a pixel as partial volume makes them."""
    j, i = np.meshgrid(np.arange(80.0), np.arange(84.0), indexing="ij")
    frames = np.empty((FRAMES, slices, 80, 84), np.float32)
    for frame, (size, shift) in enumerate(zip(SIZE, SHIFT, strict=True)):
        distance = np.hypot(i - CENTRE[0] - shift[0], j - CENTRE[1] - shift[1])
        for k, radius in enumerate(RADIUS[:slices]):
            outer = np.sqrt((size * radius) ** 2 + (radius + WALL) ** 2 - radius**2)
            blood, muscle = (1.0 / (1.0 + np.exp(4.0 * (distance - r))) for r in (size * radius, outer))
            frames[frame, k] = 20.0 + 60.0 * muscle + 150.0 * blood
    return ImageSequence(replace(GRID, size=(84, 80, slices)), frames, np.arange(FRAMES) / FRAMES, 1.0)


def circle(k: int) -> np.ndarray:
    """The edge of the blood of slice k in the first frame, m."""
    angle = np.linspace(0.0, 2.0 * np.pi, 72, endpoint=False)
    edge = CENTRE + RADIUS[k] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return GRID.points(np.column_stack([edge, np.full(72, k)]))


@pytest.fixture(scope="module")
def motion() -> SliceMotion:
    return register_slices(beating_discs(), np.vstack([circle(0), circle(1)]), Demons(smoothing=0.75))


def relative_areas(motion: SliceMotion, k: int) -> np.ndarray:
    """Area of the carried edge over that of the true disc in every frame."""
    i, j = np.moveaxis(GRID.index(motion.carry(circle(k)))[..., :2], -1, 0)
    area = 0.5 * (i * np.roll(j, -1, axis=1) - j * np.roll(i, -1, axis=1)).sum(axis=1)
    return area / (np.pi * (SIZE * RADIUS[k]) ** 2)


@pytest.mark.parametrize("k", [0, 1])
def test_a_contracting_disc_keeps_its_area_to_one_per_cent(motion: SliceMotion, k: int) -> None:
    assert relative_areas(motion, k) == pytest.approx(1.0, abs=0.01)
    place = GRID.index(motion.carry(circle(k)))
    middle = (place.min(axis=1) + place.max(axis=1))[:, :2] / 2.0  # single points may slip along the edge
    assert middle == pytest.approx(CENTRE + SHIFT, abs=0.1)
    assert place[..., 2] == pytest.approx(k, abs=1e-9)


def test_smoothing_reduces_the_measured_contraction(motion: SliceMotion) -> None:
    """Effect of three voxels, as in the study of real images: a tenth of the area at end systole."""
    smooth_motion = register_slices(beating_discs(1), circle(0), Demons(smoothing=3.0))
    smooth = relative_areas(smooth_motion, 0)[FRAMES // 2]
    assert 1.08 < smooth < 1.10
    assert abs(relative_areas(motion, 0)[FRAMES // 2] - 1.0) < 0.1 * (smooth - 1.0)


def test_the_first_frame_stays_and_no_element_folds(motion: SliceMotion) -> None:
    assert np.array_equal(motion.carry(circle(0))[0], circle(0))
    assert motion.least_jacobian()[0] == pytest.approx(1.0)
    require_unfolded(motion)


@pytest.mark.parametrize("index", [[43.0, 38.0, 0.5], [2.0, 38.0, 0.0], [43.0, 78.0, 1.0], [43.0, 38.0, 2.0]])
def test_a_point_between_slices_or_outside_is_refused(motion: SliceMotion, index: list[float]) -> None:
    with pytest.raises(InputError, match="1 of 1 points"):
        motion.carry(GRID.points(np.array([index])))


def test_frames_that_fold_are_named() -> None:
    field = np.zeros((FRAMES, 2, 12, 12, 2))
    field[5, 1, ..., 0] = -1.2 * np.arange(12.0)
    folding = SliceMotion(GRID, (0, 0), field)
    assert folding.least_jacobian()[5, 1] == pytest.approx(-0.2)
    with pytest.raises(InputError, match=r"slice 1\b.*frame 5\b.*-0\.2\b"):
        require_unfolded(folding)


def test_frames_are_followed_from_neighbour_to_neighbour() -> None:
    """Stripes 16 pixels apart, which move by 4 a frame: alone, the fourth frame looks as the first."""
    step = 4.0 * np.minimum(np.arange(FRAMES), FRAMES - np.arange(FRAMES))
    j, i = np.meshgrid(np.arange(64.0), np.arange(64.0), indexing="ij")
    stripes = [np.cos(2.0 * np.pi * (i - shift) / 16.0) + np.cos(2.0 * np.pi * j / 16.0) for shift in step]
    grid = Grid((64, 64, 1), np.array([PIXEL, PIXEL, STEP]), np.zeros(3), np.eye(3))
    images = ImageSequence(grid, np.array(stripes)[:, None], np.arange(FRAMES) / FRAMES, 1.0)
    middle = grid.points(np.array([[32.0, 32.0, 0.0]]))
    carried = grid.index(register_slices(images, middle).carry(middle))[:, 0]
    assert carried - [32.0, 32.0, 0.0] == pytest.approx(np.outer(step, [1.0, 0.0, 0.0]), abs=0.5)
