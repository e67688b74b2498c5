"""Regional curves of motions in closed form: even contraction, rigid motion, and a base that descends."""

import numpy as np
import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.curve import Curve
from heartfit.observation.regional import (
    BASE_DESCENT,
    CIRCUMFERENTIAL,
    KINDS,
    LONGITUDINAL,
    kind_of,
    names_of_kind,
    regional_curves,
    require_common_frames,
    strain_name,
)

PERIOD = 0.8
TIMES = np.arange(12) * PERIOD / 12
SHARE = np.sin(np.pi * np.arange(12) / 12) ** 2  # 0 in phase 0, 1 in phase 6


def contraction(mesh: VentricularMesh, across: float, along: float) -> Motion:
    """Scale the distances from the axis and along it, about the apex, by these factors at the end."""
    axes = LeftVentricularAxes.from_mesh(mesh)
    offset = mesh.points - axes.apex
    height = (offset @ axes.axis)[:, None] * axes.axis
    change = (across - 1.0) * (offset - height) + (along - 1.0) * height
    return Motion(TIMES, PERIOD, mesh.points + SHARE[:, None, None] * change)


def green_lagrange(scale: float) -> np.ndarray:
    return 0.5 * ((1.0 + (scale - 1.0) * SHARE) ** 2 - 1.0)


def test_an_even_contraction_has_its_strain_in_all_segments(ventricle: VentricularMesh) -> None:
    curves = regional_curves(ventricle, contraction(ventricle, 0.8, 0.9))
    for kind, scale in ((CIRCUMFERENTIAL, 0.8), (LONGITUDINAL, 0.9)):
        for name in names_of_kind(kind):
            assert curves[name].values == pytest.approx(green_lagrange(scale), abs=1e-12)


def test_the_base_descends_by_the_shortening_of_the_axis(ventricle: VentricularMesh) -> None:
    """The rims lie at the mean height of the ring, which the axes have as their length."""
    curves = regional_curves(ventricle, contraction(ventricle, 0.8, 0.9))
    length = LeftVentricularAxes.from_mesh(ventricle).length
    assert curves[BASE_DESCENT].values == pytest.approx(0.1 * length * SHARE, rel=1e-6, abs=1e-12)


def test_a_rigid_motion_has_no_strain_and_descends_by_its_axial_part(ventricle: VentricularMesh) -> None:
    axes = LeftVentricularAxes.from_mesh(ventricle)
    shift = 3e-3 * axes.septal - 2e-3 * axes.axis
    positions = []
    for share in SHARE:
        cosine, sine = np.cos(0.3 * share), np.sin(0.3 * share)
        septal, anterior = cosine * axes.septal + sine * axes.anterior, np.cross(axes.axis, axes.septal)
        anterior = cosine * anterior - sine * axes.septal
        local = (ventricle.points - axes.apex) @ np.array([axes.septal, axes.anterior, axes.axis]).T
        positions.append(axes.apex + local @ np.array([septal, anterior, axes.axis]) + share * shift)
    curves = regional_curves(ventricle, Motion(TIMES, PERIOD, np.array(positions)))
    for kind in (CIRCUMFERENTIAL, LONGITUDINAL):
        for name in names_of_kind(kind):
            assert curves[name].values == pytest.approx(np.zeros(12), abs=1e-12)
    assert curves[BASE_DESCENT].values == pytest.approx(2e-3 * SHARE, abs=1e-12)


def test_phase_0_is_the_reference_wherever_it_is(ventricle: VentricularMesh) -> None:
    """The same beat that starts in another phase: all curves start at zero there."""
    motion = contraction(ventricle, 0.8, 0.9)
    turned = Motion(TIMES, PERIOD, np.roll(motion.positions, -4, axis=0))
    for curve in regional_curves(ventricle, turned).values():
        assert curve.values[0] == pytest.approx(0.0, abs=1e-12)


def test_curves_have_the_times_of_the_motion_and_names_by_segment(ventricle: VentricularMesh) -> None:
    curves = regional_curves(ventricle, contraction(ventricle, 0.9, 0.9))
    assert list(curves) == [name for kind in KINDS for name in names_of_kind(kind)]
    assert len(curves) == 33
    assert strain_name(CIRCUMFERENTIAL, 7) == "strain_circumferential_07"
    assert all((curve.times == TIMES).all() and curve.period == PERIOD for curve in curves.values())


def test_names_and_kinds_belong_together() -> None:
    assert [kind_of(name) for kind in KINDS for name in names_of_kind(kind)] == ["circumferential"] * 16 + [
        "longitudinal"
    ] * 16 + ["base_descent"]


@pytest.mark.parametrize("name", ["strain_radial_07", "strain_circumferential_17", "lv_volume"])
def test_other_names_are_refused(name: str) -> None:
    with pytest.raises(InputError, match=f"no curve {name}"):
        kind_of(name)


def test_other_kinds_are_refused() -> None:
    with pytest.raises(InputError, match="no kind radial"):
        names_of_kind("radial")


def test_a_mesh_without_segments_is_refused(ventricle: VentricularMesh) -> None:
    bare = VentricularMesh(ventricle.points, ventricle.tets, ventricle.surfaces)
    with pytest.raises(InputError, match="no AHA segments"):
        regional_curves(bare, contraction(ventricle, 0.9, 0.9))


def test_curves_at_different_times_are_refused() -> None:
    one, other = Curve(TIMES, SHARE, PERIOD), Curve(TIMES + 0.01, SHARE, PERIOD)
    require_common_frames([one, one])
    with pytest.raises(InputError, match="times of the curves differ"):
        require_common_frames([one, other])
