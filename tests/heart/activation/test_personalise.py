"""Left bundle branch block with the duration of a measured QRS complex."""

from dataclasses import replace

import pytest

from heartfit.core.errors import InputError
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.activation.conduction import HEALTHY, LAYER_SPEEDS, LBBB, fit_conduction, total_duration


def test_without_a_duration_the_mesh_is_unchanged(ventricle: VentricularMesh) -> None:
    assert fit_conduction(ventricle, HEALTHY, None) is HEALTHY


def test_a_faster_layer_shortens_the_activation(ventricle: VentricularMesh) -> None:
    speeds = (0.4, 0.7, 1.0, 1.5)
    durations = [total_duration(ventricle, replace(LBBB, left_layer=speed)) for speed in speeds]
    assert durations == sorted(durations, reverse=True)


def test_the_layer_alone_reaches_a_usual_duration(ventricle: VentricularMesh) -> None:
    fit = fit_conduction(ventricle, LBBB, 0.125)
    assert total_duration(ventricle, fit) == pytest.approx(0.125, abs=1e-3)
    assert fit == replace(LBBB, left_layer=fit.left_layer)
    assert LAYER_SPEEDS[0] < fit.left_layer < LAYER_SPEEDS[1]


@pytest.mark.parametrize(("duration", "layer"), [(0.095, LAYER_SPEEDS[1]), (0.180, LAYER_SPEEDS[0])])
def test_durations_beyond_the_reach_of_the_layer_change_the_wall_speed(
    ventricle: VentricularMesh, duration: float, layer: float
) -> None:
    fit = fit_conduction(ventricle, LBBB, duration)
    assert total_duration(ventricle, fit) == pytest.approx(duration, abs=1e-3)
    assert fit == replace(LBBB, left_layer=layer, speed=fit.speed)
    assert (fit.speed < LBBB.speed) == (duration > 0.1)


@pytest.mark.parametrize("duration", [0.02, 0.6])
def test_an_unreachable_duration_is_refused_with_the_reachable_range(
    ventricle: VentricularMesh, duration: float
) -> None:
    with pytest.raises(InputError, match=r"QRS.*\d+ ms.*\d+.*\d+ ms"):
        fit_conduction(ventricle, LBBB, duration)
