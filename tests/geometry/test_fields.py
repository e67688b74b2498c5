"""Fibres, segments and axes of parametric ventricles, whose apex points to -z and whose septum lies at +x."""

import numpy as np
import pytest

from heartfit.core.arrays import COLUMN, ROW
from heartfit.geometry.coordinates import LeftVentricularAxes, septal_faces
from heartfit.geometry.fibres import FibreRule
from heartfit.geometry.mesh import VentricularMesh


def helix_angle(mesh: VentricularMesh, fibres: np.ndarray) -> np.ndarray:
    """Angle of each tet from circumferential to longitudinal [degrees], right-handed positive."""
    axes = LeftVentricularAxes.from_mesh(mesh)
    outward = axes.away(mesh.points[mesh.tets].mean(axis=1))
    around = np.cross(axis := axes.axis, outward) / np.linalg.norm(outward, axis=1, keepdims=True)
    across, along = (fibres * around).sum(axis=1), fibres @ axis
    return np.rad2deg(np.arctan(along / across))


def free_wall(mesh: VentricularMesh) -> np.ndarray:
    """Basal and mid segments that the right ventricle does not touch."""
    assert mesh.segments is not None
    return np.isin(mesh.segments, [5, 6, 11, 12])


def test_the_axes_of_a_heart_that_stands_upright(ventricle: VentricularMesh) -> None:
    axes = LeftVentricularAxes.from_mesh(ventricle)
    assert axes.axis == pytest.approx([0.0, 0.0, 1.0], abs=0.12)
    assert axes.septal == pytest.approx([1.0, 0.0, 0.0], abs=0.12)
    assert axes.anterior == pytest.approx([0.0, 1.0, 0.0], abs=0.12)
    zeta = ventricle.longitudinal
    assert zeta is not None
    assert zeta[np.unique(ventricle.surfaces["base"])].min() > 0.9
    assert zeta[ventricle.points[:, 2].argmin()] < 0.05


@pytest.mark.parametrize("angle", [-50.0, 0.0, 50.0])
def test_equal_angles_of_both_surfaces_hold_throughout_the_free_wall(
    ventricle: VentricularMesh, angle: float
) -> None:
    fibres = FibreRule.from_mesh(ventricle, np.deg2rad(angle), np.deg2rad(angle)).fibres()
    assert np.linalg.norm(fibres, axis=1) == pytest.approx(np.ones(len(fibres)))
    assert np.median(helix_angle(ventricle, fibres)[free_wall(ventricle)]) == pytest.approx(angle, abs=6.0)


def test_the_angle_falls_from_endocardium_to_epicardium_and_passes_zero_midway(
    ventricle: VentricularMesh,
) -> None:
    fibres = FibreRule.from_mesh(ventricle, np.deg2rad(60.0), -np.deg2rad(60.0)).fibres()
    angle = helix_angle(ventricle, fibres)
    centres = ventricle.points[ventricle.tets].mean(axis=1)
    wall = free_wall(ventricle)
    depth = np.hypot(centres[:, 0], centres[:, 1])[wall]
    inner, outer = depth < np.quantile(depth, 0.3), depth > np.quantile(depth, 0.7)
    assert np.median(angle[wall][inner]) > 10.0
    assert np.median(angle[wall][outer]) < -10.0
    assert abs(np.median(angle[wall])) < 20.0


def test_every_segment_lies_at_its_named_place(ventricle: VentricularMesh) -> None:
    segments = ventricle.segments
    assert segments is not None
    centres = ventricle.points[ventricle.tets].mean(axis=1)
    middle = np.array([centres[segments == i].mean(axis=0) for i in range(18)])
    assert np.isfinite(middle).all()
    assert middle[[1, 7, 13], 1].min() > 0.0  # anterior
    assert middle[[4, 10, 15], 1].max() < 0.0  # inferior
    assert middle[[2, 3, 8, 9, 14], 0].min() > 0.0  # septal
    assert middle[[5, 6, 11, 12, 16], 0].max() < 0.0  # lateral
    assert middle[1:7, 2].min() > middle[7:13, 2].max() > middle[13:17, 2].min() > middle[17, 2]
    assert middle[0, 0] > middle[2, 0]  # the right free wall lies beyond the septum


def test_the_septum_is_the_side_of_the_right_cavity_that_touches_the_left_wall(
    ventricle: VentricularMesh,
) -> None:
    septum = septal_faces(ventricle, LeftVentricularAxes.from_mesh(ventricle))
    far = ventricle.points[np.unique(ventricle.surfaces["rv_endo"]), 0].max()
    share = len(septum) / len(ventricle.surfaces["rv_endo"])
    assert 0.25 < share < 0.5
    assert ventricle.points[septum].mean(axis=1)[:, 0].max() < 0.8 * far


def test_fields_of_wrong_length_are_refused(ventricle: VentricularMesh) -> None:
    with pytest.raises(ValueError, match=r"fibres.*shape"):
        VentricularMesh(ventricle.points, ventricle.tets, ventricle.surfaces, fibres=np.ones((3, 3)))


@pytest.mark.parametrize("angle", [30.0, 60.0, 80.0])
def test_a_wall_of_one_tetrahedron_has_the_longitudinal_fibres_of_a_fine_one(
    ventricle: VentricularMesh, angle: float
) -> None:
    """The mean of sin^2 over angles that run evenly from a to -a is 1/2 - sin(2 a) / (4 a)."""
    a = np.deg2rad(angle)
    rule = FibreRule.from_mesh(ventricle, a, -a)
    volumes = ventricle.element_volumes()[free_wall(ventricle)]
    axis = LeftVentricularAxes.from_mesh(ventricle).axis
    tensors = rule.orientation()[free_wall(ventricle)][:, [[0, 3, 4], [3, 1, 5], [4, 5, 2]]]
    along = np.average(np.einsum("i,eij,j->e", axis, tensors, axis), weights=volumes)
    assert np.trace(tensors, axis1=1, axis2=2) == pytest.approx(np.ones(len(tensors)))
    assert along == pytest.approx(0.5 - np.sin(2.0 * a) / (4.0 * a), abs=0.05)
    sampled = np.average((rule.fibres()[free_wall(ventricle)] @ axis) ** 2, weights=volumes)
    assert sampled < 0.75 * along


def test_without_rotation_of_the_helix_the_orientation_is_that_of_the_fibre(
    ventricle: VentricularMesh,
) -> None:
    rule = FibreRule.from_mesh(ventricle, 0.5, 0.5)
    along = np.einsum("ei,ej->eij", rule.fibres(), rule.fibres())[:, ROW, COLUMN]
    assert np.median(abs(rule.orientation() - along)[free_wall(ventricle)]) < 0.01


def test_no_fibre_direction_is_a_rounding_residue(ventricle):
    """A shift of every point by its last digit would show in vanishing gradients and in parallel ones."""
    nudged = ventricle.with_points(np.nextafter(ventricle.points, 9.0))
    here, there = FibreRule.from_mesh(ventricle), FibreRule.from_mesh(nudged)
    np.testing.assert_allclose(there.fibres(), here.fibres(), atol=1e-9)
    np.testing.assert_allclose(there.orientation(), here.orientation(), atol=1e-9)
