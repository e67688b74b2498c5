"""Images on other voxels: a linear brightness stays where it is in space."""

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


def assert_linear(found: ImageSequence) -> None:
    for frame, image in enumerate(found.voxels):
        assert image == pytest.approx(places(found.grid) @ SLOPE + frame, abs=1e-12)


def test_cubic_voxels_fill_what_lies_between_the_outermost_centres(sequence: ImageSequence) -> None:
    found = resample_isotropic(sequence)
    assert found.grid.size == (12, 11, 13)
    assert found.grid.spacing.tolist() == [2e-3] * 3
    assert_linear(found)
    assert resample_isotropic(found) is found


def test_a_cropped_image_holds_the_points_and_their_margin(sequence: ImageSequence) -> None:
    points = sequence.grid.points(np.array([[4.5, 5.0, 3.2], [6.1, 5.5, 3.9]]))
    found = crop(sequence, points, 2e-3)
    assert found.grid.size == (6, 4, 4)
    assert found.grid.origin == pytest.approx(sequence.grid.points(np.array([3.0, 4.0, 2.0])))
    assert_linear(found)


def test_beyond_the_image_there_is_nothing_to_keep(sequence: ImageSequence) -> None:
    found = crop(sequence, sequence.grid.points(np.array([[0.5, 5.0, 3.0]])), 1.0)
    assert found.grid.size == sequence.grid.size
    assert_linear(found)
