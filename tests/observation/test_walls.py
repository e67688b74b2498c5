"""Septal flash of curves of known size, and wall motion of motions in closed form."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.geometry.coordinates import LeftVentricularAxes
from heartfit.geometry.mesh import Motion, VentricularMesh
from heartfit.observation.strain import (
    PRE_TRIGGER,
    WallMotion,
    early_stretch,
    septal_flash,
    shortening_delay,
    wall_motion,
)

PERIOD = 0.8
TIMES = 0.005 * np.arange(160)


def curve(knots: dict[float, float]) -> np.ndarray:
    """Linear between {time: value}, periodic."""
    return np.interp(TIMES, list(knots), list(knots.values()), period=PERIOD)


CAVITY = curve({0.0: 200e-6, 0.08: 200e-6, 0.38: 120e-6, 0.6: 190e-6, 0.65: 192e-6})
FLASHING = {-0.02: 0.0, 0.08: 4e-3, 0.12: 3.5e-3, 0.3: 6e-3, 0.5: 1e-3, 0.7: 0.5e-3}
STEADY = {-0.02: 0.0, 0.3: 6e-3, 0.5: 1e-3, 0.7: 0.5e-3}
SEPTAL = {-0.02: 0.01, 0.30: -0.15, 0.6: 0.0}
LATERAL = {0.0: 0.0, 0.10: 0.12, 0.43: -0.15, 0.6: -0.05}


def walls(septal: dict[float, float]) -> WallMotion:
    strains = curve(SEPTAL), curve(LATERAL)
    return WallMotion(TIMES, curve(septal), np.zeros(160), *strains, CAVITY)


def test_a_flash_has_its_size_its_time_and_its_rebound() -> None:
    flash = septal_flash(walls(FLASHING))
    assert flash is not None
    assert (flash.start, flash.end) == (pytest.approx(-0.02), pytest.approx(0.08))
    assert flash.size == pytest.approx(4e-3)
    assert flash.rebound == pytest.approx(0.5e-3)


def test_a_septum_moving_until_end_systole_does_not_flash() -> None:
    assert septal_flash(walls(STEADY)) is None


def test_a_stop_in_late_ejection_is_no_flash() -> None:
    late = {-0.02: 0.0, 0.22: 4e-3, 0.26: 3.5e-3, 0.3: 6e-3, 0.5: 1e-3, 0.7: 0.5e-3}
    assert septal_flash(walls(late)) is None


def test_a_heart_that_also_moves_as_a_whole_flashes_by_as_much() -> None:
    shifted = replace(walls(FLASHING), septal=curve(FLASHING) + 0.01)
    flash = septal_flash(shifted)
    assert flash is not None
    assert flash.size == pytest.approx(4e-3)


def test_stretch_and_delay_are_those_of_the_curves() -> None:
    assert early_stretch(walls(FLASHING)) == pytest.approx(0.12)
    assert shortening_delay(walls(FLASHING)) == pytest.approx(0.13)


def test_the_beat_is_shown_from_before_the_trigger_in_order() -> None:
    motion = walls(FLASHING).starting_before_trigger()
    assert motion.times == pytest.approx(TIMES - PRE_TRIGGER)
    assert motion.septal[30:] == pytest.approx(curve(FLASHING)[:130])


@pytest.mark.parametrize("shift", [0.002, -0.003])
def test_a_shift_to_the_left_moves_the_septum_inward_and_the_lateral_wall_outward(
    ventricle: VentricularMesh, shift: float
) -> None:
    axes, share = LeftVentricularAxes.from_mesh(ventricle), np.linspace(0.0, 1.0, 10)
    positions = ventricle.points - shift * share[:, None, None] * axes.septal
    motion = wall_motion(ventricle, Motion(0.08 * np.arange(10), PERIOD, positions))
    assert motion.septal == pytest.approx(shift * share)
    assert motion.lateral == pytest.approx(-shift * share)
    assert motion.septal_strain == pytest.approx(np.zeros(10), abs=1e-12)


def test_shrinking_about_the_axis_shortens_both_walls_equally(ventricle: VentricularMesh) -> None:
    axes, shares = LeftVentricularAxes.from_mesh(ventricle), np.linspace(0.0, 1.0, 10)
    away = axes.away(ventricle.points)
    positions = np.array([ventricle.points - 0.2 * share * away for share in shares])
    motion = wall_motion(ventricle, Motion(0.08 * np.arange(10), PERIOD, positions))
    strain = 0.5 * ((1.0 - 0.2 * shares) ** 2 - 1.0)
    for measured in (motion.septal_strain, motion.lateral_strain):
        assert measured == pytest.approx(strain, abs=1e-9)
    assert min(motion.septal[-1], motion.lateral[-1]) > 2e-3
