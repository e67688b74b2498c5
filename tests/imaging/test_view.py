"""Pixels of a view and outlines have their true places in space."""

import numpy as np
import pytest

from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import VentricularMesh
from heartfit.imaging.sampling import View, views
from heartfit.imaging.sequence import Grid

TURN = np.linalg.qr(np.random.default_rng(3).standard_normal((3, 3)))[0]


@pytest.fixture
def grid() -> Grid:
    return Grid((30, 28, 26), np.array([2e-3, 2.5e-3, 3e-3]), np.array([0.1, -0.2, 0.05]), TURN)


def test_a_linear_image_is_shown_exactly(grid: Grid) -> None:
    """Brightness a.x + b is linear between voxels, so every pixel shows a.x + b of its own place."""
    slope = np.array([30.0, -20.0, 50.0])
    indices = np.moveaxis(np.indices(grid.shape), 0, -1)[..., ::-1]
    image = grid.points(indices.astype(float)) @ slope + 4.0
    right, up = np.linalg.qr(np.random.default_rng(5).standard_normal((3, 3)))[0][:2]
    view = View(
        grid.points(np.array([15.0, 14.0, 13.0])), right, up, np.array([-0.01, -0.02]), np.array([0.02, 0.01])
    )
    picture = view.picture(image, grid, 1e-3)
    across, along = -0.01 + 1e-3 * (np.arange(30) + 0.5), -0.02 + 1e-3 * (np.arange(30) + 0.5)
    place = view.origin + along[:, None, None] * up + across[:, None] * right
    assert picture == pytest.approx(place @ slope + 4.0, abs=1e-12)


def test_places_beyond_the_image_are_dark(grid: Grid) -> None:
    view = View(
        grid.points(np.array([60.0, 14.0, 13.0])), TURN[:, 1], TURN[:, 2], np.zeros(2), np.full(2, 0.01)
    )
    assert (view.picture(np.ones(grid.shape), grid, 1e-3) == 0.0).all()


def test_outlines_are_where_the_surface_meets_the_plane() -> None:
    """A triangle in the plane x = 3 is cut by z = 1 along a segment of known ends."""
    points = np.array([[3.0, 0.0, 0.0], [3.0, 4.0, 0.0], [3.0, 0.0, 2.0]])
    view = View(np.array([1.0, 1.0, 1.0]), np.eye(3)[0], np.eye(3)[1], np.zeros(2), np.ones(2))
    (segment,) = view.outline(points, np.array([[0, 1, 2]]))
    assert sorted(segment.tolist()) == [[2.0, -1.0], [2.0, 1.0]]


@pytest.mark.parametrize("flip", [1.0, -1.0])
def test_the_base_is_above_and_the_right_ventricle_on_the_left(
    ventricle: VentricularMesh, flip: float
) -> None:
    """Short-axis slices, counted from apex to base or from base to apex."""
    axes = LeftVentricularAxes.from_mesh(ventricle)
    normal = flip * axes.axis
    direction = np.column_stack([np.cross(axes.anterior, normal), axes.anterior, normal])
    corner = ventricle.points.mean(axis=0) - direction @ np.full(3, 0.1)
    grid = Grid((100, 100, 25), np.array([2e-3, 2e-3, 8e-3]), corner, direction)
    shown = views(grid, ventricle)
    assert grid.index(shown["slice"].origin)[2] == pytest.approx(
        round(grid.index(shown["slice"].origin)[2]), abs=1e-9
    )
    towards, along = shown["towards the septum"], shown["along the septum"]
    assert towards.up @ axes.axis == pytest.approx(1.0)
    assert towards.right @ axes.septal == pytest.approx(-1.0)
    assert along.right @ axes.septal == pytest.approx(0.0, abs=1e-12)
    for view in shown.values():
        inside = view.outline(ventricle.points, ventricle.surfaces["epi"]).reshape(-1, 2)
        assert (inside > view.low).all()
        assert (inside < view.high).all()
