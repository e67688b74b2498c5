"""Image sequences: places of the voxels, and refused sequences."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.imaging.sequence import Grid, ImageSequence

FRAMES = 8
TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])


@pytest.fixture
def grid() -> Grid:
    return Grid((4, 3, 2), np.array([1e-3, 2e-3, 8e-3]), np.array([0.1, -0.2, 0.3]), TURN)


@pytest.fixture
def content(grid):
    voxels = np.random.default_rng(0).random((FRAMES, *grid.shape)).astype(np.float32)
    return {"grid": grid, "voxels": voxels, "times": 0.1 * np.arange(FRAMES), "period": 0.8}


def test_the_axis_i_points_along_the_first_column(grid):
    np.testing.assert_allclose(grid.points(np.array([1.0, 0.0, 0.0])), [0.1, -0.199, 0.3])
    np.testing.assert_allclose(grid.points(np.array([0.0, 0.0, 1.0])), [0.1, -0.2, 0.308])


def test_index_undoes_points(grid):
    index = np.random.default_rng(1).random((5, 3))
    np.testing.assert_allclose(grid.index(grid.points(index)), index, atol=1e-12)
    np.testing.assert_allclose(grid.vectors(index), grid.points(index) - grid.origin)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"spacing": np.array([1e-3, 0.0, 1e-3])}, "spacing"),
        ({"direction": np.ones((3, 3))}, "orthonormal"),
        ({"size": (4, 0, 2)}, "size"),
    ],
)
def test_an_invalid_grid_is_refused(grid, change, message):
    with pytest.raises(InputError, match=message):
        Grid(
            **{"size": grid.size, "spacing": grid.spacing, "origin": grid.origin, "direction": TURN} | change
        )


def test_end_diastole_is_the_first_frame_and_times_increase(content):
    turned = ImageSequence(**content).starting_at(6)
    np.testing.assert_array_equal(turned.voxels[:3], content["voxels"][[6, 7, 0]])
    np.testing.assert_allclose(turned.times, content["times"], atol=1e-12)


@pytest.mark.parametrize("frame", [-1, FRAMES])
def test_an_end_diastole_out_of_range_is_refused(content, frame):
    with pytest.raises(InputError, match=rf"frame {frame}\b.*\b0 to 7"):
        ImageSequence(**content).starting_at(frame)


def spoilt(content, **change):
    return ImageSequence(**content | change)


def test_an_invalid_sequence_is_refused_with_the_frame_named(content):
    hole, flat, glare = (content["voxels"].copy() for _ in range(3))
    hole[5, 1, 2, 3], flat[3], glare[2, 0, 0, 0], glare[2, 0, 0, 1] = np.nan, 7.0, 3e38, -3e38
    late = content["times"].copy()
    late[4] = late[3]
    with pytest.raises(InputError, match=r"frame 5\b.*\b1 voxels.*\(3, 2, 1\)"):
        spoilt(content, voxels=hole)
    with pytest.raises(InputError, match=r"frame 2\b.*1e\+12.*\(0, 0, 0\).*3e\+38"):
        spoilt(content, voxels=glare)
    with pytest.raises(InputError, match=r"frame 3\b.*\b7\b"):
        spoilt(content, voxels=flat)
    with pytest.raises(InputError, match=r"frame 4\b"):
        spoilt(content, times=late)
    with pytest.raises(InputError, match=r"\b8\b"):
        spoilt(content, voxels=content["voxels"][:7], times=content["times"][:7])
    with pytest.raises(InputError, match=r"\(8, 2, 3, 4\)"):
        spoilt(content, voxels=content["voxels"].transpose(0, 3, 2, 1))
    with pytest.raises(InputError, match="within"):
        spoilt(content, period=0.65)
