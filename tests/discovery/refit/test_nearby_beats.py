"""Slopes of a refit by one tangent-linear beat are those of beats that are run one by one."""

import numpy as np
import pytest

from heartfit.core.arrays import Floats
from heartfit.core.errors import InputError
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.model import TANGENT, Model, activate
from heartfit.discovery.refit.nearby_beats import (
    DIFFERENCE,
    NearbyBeats,
    points_around,
    simulate_each,
)
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat
from heartfit.personalise.numerics import Pressures, TimeScheme
from heartfit.personalise.run import nearby_beats
from heartfit.personalise.setting import Setting

PERIOD, PRESSURES = 0.8, Pressures(lv=1.2e3, rv=0.5e3)
SCHEME = TimeScheme(time_step=0.02, second_order=True, max_beats=20, drift=1e-3)
MUSCLE = {"estimate": ("sigma_0", "c_1")}


def setting(element: str) -> Setting:
    return Setting.model_validate(MUSCLE | {"element": element}).with_prior({})


def volume_slopes(around: NearbyBeats) -> Floats:
    """Derivatives (t, d) of the left volume by the coordinates."""
    volumes = np.array([beat.volume["lv"] for beat in (around.centre, *around.others)])
    slopes: Floats = (volumes[1:] - volumes[0]).T / around.step
    return slopes


def test_points_lie_one_step_further_along_each_coordinate() -> None:
    x = np.array([0.5, 0.0, -1.0])
    points = points_around(x, 0.1)
    assert points.shape == (4, 3)
    assert (points[0] == x).all()
    assert points[1:] - x == pytest.approx(0.1 * np.eye(3))


def test_a_tangent_beat_agrees_with_beats_one_by_one(ventricle: VentricularMesh) -> None:
    """Differences of a quarter of a standard deviation differ from derivatives by their curvature."""
    model = Model(activate(ventricle), PERIOD, PRESSURES, SCHEME)
    extension, x = Extension.from_names(setting("mixed"), "MitralRegurgitation"), np.array([0.2, -0.3, 1.0])
    tangent, full = model.nearby(extension, x), simulate_each(model, extension, x)
    assert (tangent.step, tangent.simulations) == (TANGENT, 1)
    assert (full.step, full.simulations) == (DIFFERENCE, 4)
    slopes, expected = volume_slopes(tangent), volume_slopes(full)
    error, size = (np.sqrt(np.mean(values**2, axis=0)) for values in (slopes - expected, expected))
    assert (error < 0.1 * size).all()


def test_spheres_are_simulated_one_by_one(ventricle: VentricularMesh) -> None:
    model, sphere = Model(activate(ventricle), PERIOD, PRESSURES, SCHEME), setting("sphere")
    around = model.nearby(Extension(sphere), np.zeros(2))
    assert (around.step, around.simulations, len(around.others)) == (DIFFERENCE, 3, 2)
    with pytest.raises(InputError, match="spheres have no derivatives"):
        nearby_beats(model.mesh, sphere, PERIOD, [{}], TANGENT, PRESSURES, SCHEME)


@pytest.mark.long
def test_a_failing_beat_is_found_one_by_one(ventricle: VentricularMesh) -> None:
    """Beats that no step of time can take are failed beats, not an error."""
    soft = Extension(setting("mixed"))
    model = Model(activate(ventricle), PERIOD, Pressures(lv=4.9e3, rv=0.5e3), SCHEME)
    around = model.nearby(soft, np.array([0.0, -9.0]))
    failed: list[Beat] = [beat for beat in (around.centre, *around.others) if not beat.completed]
    assert len(failed) == 3
