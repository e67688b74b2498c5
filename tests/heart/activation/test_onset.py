"""Activation: its first site, its last site and its duration, in health and in left bundle branch block."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.geometry.coordinates import LeftVentricularAxes, septal_faces
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.activation.conduction import (
    HEALTHY,
    LBBB,
    assign_activation,
    endocardial_layer,
    nodal_times,
    onset_times,
)

SEPTUM, LATERAL = [2, 3, 8, 9, 14], [5, 6, 11, 12, 16]
POSTEROLATERAL_BASE, ANTEROLATERAL_BASE = 5, 6


@pytest.fixture(scope="module")
def blocked(ventricle: VentricularMesh) -> VentricularMesh:
    """The ventricles with left bundle branch block."""
    return assign_activation(ventricle, LBBB)


def times_of(mesh: VentricularMesh) -> Floats:
    assert mesh.activation is not None
    return mesh.activation


def mean_time(mesh: VentricularMesh, segments: list[int]) -> float:
    assert mesh.segments is not None
    return float(times_of(mesh)[np.isin(mesh.segments, segments)].mean())


def test_the_ventricles_are_active_within_sixty_to_ninety_milliseconds_or_sooner_when_small(
    ventricle: VentricularMesh,
) -> None:
    times = times_of(ventricle)
    assert times.min() == 0.0
    assert 0.050 < times.max() < 0.095


def test_the_septum_comes_first_and_the_lateral_base_late(ventricle: VentricularMesh) -> None:
    assert mean_time(ventricle, [8, 9]) < mean_time(ventricle, [5, 6])


def test_three_sites_lie_on_the_left_endocardium_and_one_on_the_right(ventricle: VentricularMesh) -> None:
    starts = onset_times(ventricle, HEALTHY.sites)
    left, right = (np.unique(ventricle.surfaces[name]) for name in ("lv_endo", "rv_endo"))
    assert np.isin(list(starts), left).sum() == 3
    assert [time for node, time in starts.items() if node in right] == [pytest.approx(0.007)]
    anterior, _, posterior = (ventricle.points[node] for node in list(starts)[:3])
    assert anterior[1] > 0.0 > posterior[1]


def test_slower_purkinje_networks_take_longer(ventricle: VentricularMesh) -> None:
    slow = assign_activation(ventricle, replace(HEALTHY, left_layer=0.6, right_layer=0.6))
    assert times_of(slow).max() > 1.3 * times_of(ventricle).max()
    assert len(endocardial_layer(ventricle, "lv_endo")) > 25


def test_each_layer_has_its_own_speed(ventricle: VentricularMesh, blocked: VentricularMesh) -> None:
    slow_right = times_of(assign_activation(ventricle, replace(LBBB, right_layer=0.6)))
    later = slow_right - times_of(blocked)
    assert later[ventricle.segments == 0].mean() > 0.010


def test_left_bundle_branch_block_starts_on_the_right_side_only(ventricle: VentricularMesh) -> None:
    septal = np.unique(septal_faces(ventricle, LeftVentricularAxes.from_mesh(ventricle)))
    on_septum = [node in septal for node in onset_times(ventricle, LBBB.sites)]
    assert on_septum == [True, False]
    assert not np.isin(
        list(onset_times(ventricle, LBBB.sites)), np.unique(ventricle.surfaces["lv_endo"])
    ).any()


def test_a_blocked_heart_is_active_right_then_septum_then_lateral_wall(blocked: VentricularMesh) -> None:
    order = [mean_time(blocked, segments) for segments in ([0], SEPTUM, LATERAL)]
    assert order == sorted(order)
    assert order[2] - order[1] > 0.040


def test_the_lateral_base_is_activated_last(blocked: VentricularMesh) -> None:
    assert blocked.segments is not None
    assert blocked.segments[times_of(blocked).argmax()] in (POSTEROLATERAL_BASE, ANTEROLATERAL_BASE)
    assert 0.100 < times_of(blocked).max() < 0.180


def test_the_wave_takes_forty_milliseconds_or_more_to_the_left_of_the_septum(
    ventricle: VentricularMesh,
) -> None:
    left = np.unique(ventricle.surfaces["lv_endo"])
    axes = LeftVentricularAxes.from_mesh(ventricle)
    height, angle = axes.longitudinal(ventricle.points[left]), axes.angle(ventricle.points[left])
    septal = left[(np.abs(angle) < np.pi / 4) & (np.abs(height - 0.5) < 0.25)]
    assert np.median(nodal_times(ventricle, LBBB)[septal]) > 0.040


def test_a_mesh_without_fibres_is_refused(ventricle: VentricularMesh) -> None:
    with pytest.raises(ValueError, match="fibres"):
        assign_activation(replace(ventricle, fibres=None))
