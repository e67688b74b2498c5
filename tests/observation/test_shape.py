"""Motions in closed form, on parametric ventricles whose apex points to -z: each quantity measures its own."""

from collections.abc import Callable

import numpy as np
import pytest

from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.heart.beat import Beat, nodal_motion
from heartfit.observation.shape import Shape, motion_shape

SHARE = np.linspace(0.0, 1.0, 8)


def _turned(x: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Points (n,3) turned by angles (n,) about the third axis."""
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.column_stack([cosine * x[:, 0] - sine * x[:, 1], sine * x[:, 0] + cosine * x[:, 1], x[:, 2]])


@pytest.fixture
def shape_of(ventricle: VentricularMesh) -> Callable[[Callable], Shape]:
    """Shape of a motion that is defined, at a share (0 to 1) of its end, in coordinates along the ventricle's axes."""
    axes = LeftVentricularAxes.from_mesh(ventricle)
    frame = np.array([axes.septal, axes.anterior, axes.axis])
    local = (ventricle.points - axes.apex) @ frame.T

    def look(move: Callable[[np.ndarray, float], np.ndarray]) -> Shape:
        positions = np.array([axes.apex + move(local, share) @ frame for share in SHARE])
        return motion_shape(ventricle, Motion(0.1 * SHARE, 0.8, positions))

    return look


def test_a_rigid_motion_has_no_change_of_shape(shape_of: Callable) -> None:
    def move(x: np.ndarray, share: float) -> np.ndarray:
        return _turned(x + np.array([0.0, 0.0, 0.01 * share]), np.full(len(x), 0.3 * share))

    shape = shape_of(move)
    for quantity in (shape.shortening, shape.thickening, shape.twist):
        assert quantity == pytest.approx(np.zeros(8), abs=1e-9)
    assert shape.volume == pytest.approx(np.ones((8, 3)))
    assert shape.rise == pytest.approx(0.01 * SHARE)
    assert shape.descent == pytest.approx(-0.01 * SHARE)


def test_a_stretch_along_the_axis_is_shortening_and_descent(shape_of: Callable) -> None:
    shape = shape_of(lambda x, share: x * [1.0, 1.0, 1.0 - 0.15 * share])
    assert shape.shortening == pytest.approx(0.15 * SHARE, rel=0.03)
    assert shape.volume == pytest.approx(np.tile(1.0 - 0.15 * SHARE, (3, 1)).T)
    assert shape.inward == pytest.approx(np.zeros(8), abs=1e-9)
    assert abs(shape.rise).max() < 0.1 * shape.descent[-1]


def test_a_uniform_contraction_shrinks_every_quantity(shape_of: Callable, ventricle: VentricularMesh) -> None:
    shape = shape_of(lambda x, share: x * (1.0 - 0.1 * share))
    assert shape.shortening == pytest.approx(0.1 * SHARE)
    assert shape.thickening == pytest.approx(-0.1 * SHARE)
    assert shape.volume == pytest.approx(np.tile((1.0 - 0.1 * SHARE) ** 3, (3, 1)).T)
    away = LeftVentricularAxes.from_mesh(ventricle).away(
        ventricle.points[np.unique(ventricle.surfaces["lv_endo"])]
    )
    inner = np.linalg.norm(away, axis=1).max()
    assert inner < shape.inward[-1] / 0.1 < inner + 0.015


def test_a_torsion_is_twist_positive_counter_clockwise_seen_from_the_apex(
    shape_of: Callable, ventricle: VentricularMesh
) -> None:
    length = LeftVentricularAxes.from_mesh(ventricle).length

    def move(x: np.ndarray, share: float) -> np.ndarray:
        return _turned(x, 0.4 * share * (x[:, 2] / length - 1.0))

    shape = shape_of(move)
    assert shape.twist == pytest.approx(0.4 * 0.5 * SHARE, rel=0.15)
    assert shape.shortening == pytest.approx(np.zeros(8), abs=0.005)


def test_a_beat_starts_at_its_trigger_and_is_refused_without_its_nodes() -> None:
    time = np.linspace(0.0, 0.8, 17)
    positions = np.tile(time[:, None, None], (1, 4, 3))
    beat = Beat(time, {}, {}, {}, period=0.8, trigger=0.2, positions=positions)
    motion = nodal_motion(beat)
    assert motion.times == pytest.approx(time[:-1])
    assert motion.positions[:, 0, 0] == pytest.approx(np.mod(time[:-1] + 0.2, 0.8), abs=1e-9)
    with pytest.raises(ValueError, match="keep_positions"):
        nodal_motion(Beat(time, {}, {}, {}, period=0.8, trigger=0.2))
