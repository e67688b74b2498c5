"""The healthy activation: where it starts, where it ends and how long it takes."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.electrophysiology.onset import assign_activation, healthy_onset, purkinje_layer
from heartfit.geometry.mesh import VentricularMesh


def test_the_ventricles_are_active_within_sixty_to_ninety_milliseconds_or_sooner_when_small(
    ventricle: VentricularMesh,
) -> None:
    times = ventricle.activation
    assert times is not None
    assert times.min() == 0.0
    assert 0.050 < times.max() < 0.095


def test_the_septum_comes_first_and_the_lateral_base_late(ventricle: VentricularMesh) -> None:
    times, segments = ventricle.activation, ventricle.segments
    assert times is not None
    assert segments is not None
    of_segment = np.array([times[segments == i].mean() for i in range(18)])
    assert of_segment[[8, 9]].mean() < of_segment[[5, 6]].mean()


def test_three_sites_lie_on_the_left_endocardium_and_one_on_the_right(ventricle: VentricularMesh) -> None:
    onset = healthy_onset(ventricle)
    left, right = (np.unique(ventricle.surfaces[name]) for name in ("lv_endo", "rv_endo"))
    assert np.isin(list(onset), left).sum() == 3
    assert [time for node, time in onset.items() if node in right] == [pytest.approx(0.007)]
    anterior, _, posterior = (ventricle.points[node] for node in list(onset)[:3])
    assert anterior[1] > 0.0 > posterior[1]


def test_a_slower_purkinje_network_takes_longer(ventricle: VentricularMesh) -> None:
    slow, fast = (assign_activation(ventricle, fast_speed=speed).activation for speed in (0.6, 3.0))
    assert slow is not None
    assert fast is not None
    assert slow.max() > 1.3 * fast.max()
    assert len(purkinje_layer(ventricle)) > 50


def test_a_mesh_without_fibres_is_refused(ventricle: VentricularMesh) -> None:
    with pytest.raises(ValueError, match="no fibres"):
        assign_activation(replace(ventricle, fibres=None))
