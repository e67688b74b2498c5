"""Resampled images: a linear brightness keeps its place in space."""

import numpy as np
import pytest

from heartfit.imaging.sampling import crop, resample_isotropic
from heartfit.imaging.sequence import Grid, ImageSequence

TURN = np.linalg.qr(np.random.default_rng(3).standard_normal((3, 3)))[0]
SLOPE = np.array([30.0, -20.0, 50.0])


def places(grid: Grid) -> np.ndarray:
    """Centres of the voxels (k,j,i,3), m."""
    return grid.points(np.moveaxis(np.indices(grid.shape), 0, -1)[..., ::-1].astype(float))


@pytest.fixture
def sequence() -> ImageSequence:
    grid = Grid((12, 11, 6), np.array([2e-3, 2e-3, 5e-3]), np.array([0.1, -0.2, 0.3]), TURN)
    voxels = np.array([places(grid) @ SLOPE + frame for frame in range(8)])
    return ImageSequence(grid, voxels, 0.1 * np.arange(8), 0.8)


def assert_linear(sequence: ImageSequence) -> None:
    for frame, image in enumerate(sequence.voxels):
        assert image == pytest.approx(places(sequence.grid) @ SLOPE + frame, abs=1e-12)


def test_cubic_voxels_fill_what_lies_between_the_outermost_centres(sequence: ImageSequence) -> None:
    resampled = resample_isotropic(sequence)
    assert resampled.grid.size == (12, 11, 13)
    assert resampled.grid.spacing.tolist() == [2e-3] * 3
    assert_linear(resampled)
    assert resample_isotropic(resampled) is resampled


def test_a_cropped_image_holds_the_points_and_their_margin(sequence: ImageSequence) -> None:
    points = sequence.grid.points(np.array([[4.5, 5.0, 3.2], [6.1, 5.5, 3.9]]))
    cropped = crop(sequence, points, 2e-3)
    assert cropped.grid.size == (6, 4, 4)
    assert cropped.grid.origin == pytest.approx(sequence.grid.points(np.array([3.0, 4.0, 2.0])))
    assert_linear(cropped)


@pytest.mark.parametrize("error", [-1e-10, 0.0, 1e-10])
def test_the_last_bits_of_a_position_move_no_edge(sequence: ImageSequence, error: float) -> None:
    """The mesh of a phantom ends a whole number of voxels from the edge of its images, up to rounding."""
    margin = 2.0 * float(sequence.grid.spacing[0])
    points = sequence.grid.points(np.array([[3.0, 4.0, 2.0], [4.0, 5.0, 3.0]])) + error
    assert crop(sequence, points, margin).grid.size == crop(sequence, points - error, margin).grid.size


def test_a_margin_beyond_the_image_ends_at_its_border(sequence: ImageSequence) -> None:
    cropped = crop(sequence, sequence.grid.points(np.array([[0.5, 5.0, 3.0]])), 1.0)
    assert cropped.grid.size == sequence.grid.size
    assert_linear(cropped)
