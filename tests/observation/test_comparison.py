"""Two motions in closed form: each error follows the formula, and all others vanish."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.comparison import Comparison, compare_motions
from heartfit.observation.curve import Curve
from heartfit.observation.operator import PressureFeatures, VolumeFeatures
from heartfit.observation.strain import DIRECTIONS, cylinder_directions, segment_strain

PERIOD = 0.8
TIMES = np.arange(12) * PERIOD / 12
SHARE = np.sin(np.pi * np.arange(12) / 12) ** 2  # 0 in phase 0, 1 in phase 6
FEATURES = {"lv_volume": VolumeFeatures(frames=12)}


def affine(mesh: VentricularMesh, matrix: np.ndarray, shift: np.ndarray | None = None) -> Motion:
    """Every phase the share SHARE of an affine map about the apex, given in septal, anterior, axial components."""
    axes = LeftVentricularAxes.from_mesh(mesh)
    frame = np.array([axes.septal, axes.anterior, axes.axis])
    local = (mesh.points - axes.apex) @ frame.T
    displaced = [local + share * (local @ (matrix - np.eye(3)).T) for share in SHARE]
    offset = np.zeros(3) if shift is None else shift
    return Motion(
        TIMES, PERIOD, np.array([(x + s * offset) @ frame for x, s in zip(displaced, SHARE, strict=True)])
    )


def contraction(mesh: VentricularMesh, across: float, along: float) -> Motion:
    return affine(mesh, np.diag([across, across, along]))


@pytest.fixture
def compared(ventricle: VentricularMesh) -> Callable[[Motion, Motion], Comparison]:
    return lambda true, registered: compare_motions(ventricle, true, registered, FEATURES)


def test_a_motion_has_no_error_to_itself(ventricle: VentricularMesh, compared: Callable) -> None:
    motion = contraction(ventricle, 0.8, 0.85)
    comparison = compared(motion, motion)
    assert comparison.observation_errors() == dict.fromkeys(("V_min", "q_max", "q_min"), 0.0)
    assert not comparison.point_error.any()
    np.testing.assert_array_equal(comparison.registered_strain, comparison.true_strain)
    assert not comparison.folded.any()
    assert comparison.end_systole == 6


def test_a_rigid_shift_is_only_a_point_error_of_its_length(
    ventricle: VentricularMesh, compared: Callable
) -> None:
    matrix = np.diag([0.8, 0.8, 0.85])
    shift = np.array([2e-3, -1e-3, 2e-3])  # 3 mm long
    comparison = compared(affine(ventricle, matrix), affine(ventricle, matrix, shift))
    assert comparison.point_error == pytest.approx(np.outer(3e-3 * SHARE, [1.0, 1.0]), abs=1e-15)
    assert comparison.point_error_of_beat[0] == pytest.approx(3e-3 * SHARE[1:].mean())
    assert comparison.registered_strain == pytest.approx(comparison.true_strain, abs=1e-13)
    assert list(comparison.observation_errors().values()) == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)


def test_a_rigid_rotation_has_no_strain(ventricle: VentricularMesh) -> None:
    cosine, sine = np.cos(0.4), np.sin(0.4)
    turn = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    motion = affine(ventricle, turn)
    at_end = replace(motion, positions=motion.positions[[0, 6] * 6])
    assert segment_strain(ventricle, at_end) == pytest.approx(np.zeros((12, 3, 16)), abs=1e-13)


def test_an_even_dilation_gives_the_strain_and_volume_of_its_scale(
    ventricle: VentricularMesh, compared: Callable
) -> None:
    comparison = compared(contraction(ventricle, 0.8, 0.8), contraction(ventricle, 0.9, 0.9))
    assert comparison.true_strain[6] == pytest.approx(np.full((3, 16), 0.5 * (0.8**2 - 1.0)))
    assert comparison.registered_strain[6] == pytest.approx(np.full((3, 16), 0.5 * (0.9**2 - 1.0)))
    assert comparison.strain_error_at_end_systole() == pytest.approx(
        np.full((3, 16), 0.5 * (0.9**2 - 0.8**2))
    )
    assert comparison.observation_errors()["V_min"] == pytest.approx((0.9 / 0.8) ** 3 - 1.0)
    expected = 0.5 * ((1.0 - 0.1 * SHARE) ** 2 - (1.0 - 0.2 * SHARE) ** 2)
    difference = comparison.registered_strain - comparison.true_strain
    assert difference == pytest.approx(np.broadcast_to(expected[:, None, None], difference.shape))


def test_each_direction_measures_its_own_stretch(ventricle: VentricularMesh) -> None:
    """A stretch along the axis and one across it: circumference and radius change alike in an affine map."""
    strain = segment_strain(ventricle, contraction(ventricle, 0.9, 0.7))[6]
    expected = {"circumferential": 0.9, "longitudinal": 0.7, "radial": 0.9}
    for row, direction in zip(strain, DIRECTIONS, strict=True):
        assert row == pytest.approx(np.full(16, 0.5 * (expected[direction] ** 2 - 1.0)))


def test_circumference_and_radius_are_distinguished(ventricle: VentricularMesh) -> None:
    """A stretch in one direction across the axis: radial where the segment faces it, circumferential beside it.

    Of segments 7 to 12, the septal and lateral ones face it. E_nn = (s^2 - 1)/2 (n.e)^2 in each tetrahedron.
    """
    strain = segment_strain(ventricle, affine(ventricle, np.diag([1.2, 1.0, 1.0])))[6]
    whole = 0.5 * (1.2**2 - 1.0)
    assert strain[0] + strain[2] == pytest.approx(np.full(16, whole))
    assert strain[1] == pytest.approx(np.zeros(16), abs=1e-13)
    # AHA 8, 9 share the septum and 11, 12 the free wall: within 60 degrees of the stretch; 7, 10 across it
    assert (strain[2, [7, 8, 10, 11]] > 0.5 * whole).all()
    assert (strain[2, [6, 9]] < 0.5 * whole).all()


def test_directions_are_orthonormal_and_right_handed(ventricle: VentricularMesh) -> None:
    frames = cylinder_directions(ventricle)
    assert frames @ frames.swapaxes(1, 2) == pytest.approx(np.tile(np.eye(3), (len(frames), 1, 1)), abs=1e-12)
    assert np.linalg.det(frames) == pytest.approx(np.ones(len(frames)))


def test_a_segment_is_the_mean_over_its_volume(ventricle: VentricularMesh) -> None:
    """Strain of a general motion, tetrahedron by tetrahedron: F from the edges, E = (F'F - 1)/2."""
    random, start = np.random.default_rng(1), ventricle.points
    positions = np.array([start + share * 2e-4 * random.standard_normal(start.shape) for share in SHARE])
    strain = segment_strain(ventricle, Motion(TIMES, PERIOD, positions))
    inside = ventricle.tets[ventricle.segments == 14]
    before, after = ((x[inside[:, 1:]] - x[inside[:, :1]]).swapaxes(1, 2) for x in (start, positions[5]))
    F = after @ np.linalg.inv(before)
    E = 0.5 * (F.swapaxes(1, 2) @ F - np.eye(3))
    axis = LeftVentricularAxes.from_mesh(ventricle).axis
    expected = np.average(axis @ E @ axis, weights=np.linalg.det(before))
    assert strain[5, DIRECTIONS.index("longitudinal"), 13] == pytest.approx(expected)


def test_a_fold_is_counted_in_its_segment(ventricle: VentricularMesh, compared: Callable) -> None:
    true = contraction(ventricle, 0.9, 0.9)
    positions = true.positions.copy()
    a, b, c, d = positions[3, ventricle.tets[100]]
    positions[3, ventricle.tets[100][0]] += 2.0 * ((b + c + d) / 3.0 - a)
    comparison = compared(true, replace(true, positions=positions))
    assert comparison.folded[3] >= 1
    assert not np.delete(comparison.folded, 3).any()


def test_a_catheter_adds_the_observations_of_pressure(ventricle: VentricularMesh) -> None:
    motion = contraction(ventricle, 0.8, 0.8)
    times = np.arange(200) * PERIOD / 200
    true = Curve(times, 8e3 - 7e3 * np.cos(2 * np.pi * times / PERIOD), PERIOD)
    recorded = replace(true, values=1.1 * true.values)
    features = FEATURES | {"lv_pressure": PressureFeatures()}
    errors = compare_motions(ventricle, motion, motion, features, (true, recorded)).observation_errors()
    pressure_errors = [errors[name] for name in ("P_max", "dPdt_max", "dPdt_min")]
    assert pressure_errors == pytest.approx([0.1, 0.1, 0.1])
    assert errors["V_min"] == 0.0


def test_motions_that_cannot_be_compared_are_refused(ventricle: VentricularMesh, compared: Callable) -> None:
    motion = contraction(ventricle, 0.8, 0.8)
    with pytest.raises(InputError, match=r"\b5 nodes"):
        compared(motion, replace(motion, positions=motion.positions[:, :5]))
    with pytest.raises(InputError, match=r"\b12\b.*\b11\b"):
        compared(motion, Motion(TIMES[:11], PERIOD, motion.positions[:11]))
    with pytest.raises(InputError, match=r"\b0\.01 s"):
        compared(motion, replace(motion, times=TIMES + 0.01))
    with pytest.raises(InputError, match="AHA"):
        segment_strain(replace(ventricle, segments=None), motion)
    without = replace(ventricle, segments=np.where(ventricle.segments == 5, 6, ventricle.segments))
    with pytest.raises(InputError, match=r"segment 5\b"):
        segment_strain(without, motion)
