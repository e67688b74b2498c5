"""The spherical forward model is the simulated sphere, observed by the operators; a failure has a reason."""

import numpy as np
import pytest

from heartfit.heart.heart import Heart
from heartfit.heart.muscle.passive import require_isotropic
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.observation.beat import observe_beats
from heartfit.observation.operator import PressureFeatures, VolumeFeatures
from heartfit.synthetic.known_hearts import SphericalCase

FEATURES = {"lv_volume": VolumeFeatures(), "lv_pressure": PressureFeatures()}
HEART = Heart().with_parameters({"sigma_0": 150e3})
MODEL = SphericalCase(HEART, 150e-6, 120e-6, 1300.0, FEATURES, Numerics(max_beats=2))


def test_the_forward_model_is_the_sphere_of_its_volumes_observed_by_the_operators() -> None:
    heart = HEART.with_parameters({"c_1": 7e3})
    sphere = Sphere.unloaded(150e-6, 120e-6, 1300.0, require_isotropic(heart.tissue.passive))
    (expected,) = observe_beats([simulate_spheres(heart, [sphere], MODEL.numerics)], FEATURES)
    assert MODEL.observe_all([{"c_1": 7e3}]) == [expected]


def test_a_sphere_that_does_not_exist_or_beat_is_an_outcome() -> None:
    torn, slack = MODEL.observe_all([{"sigma_0": 150e6}, {"c_1": 1e-3, "c_2": 1e-3}])
    assert isinstance(torn, str)
    assert isinstance(slack, str)


def test_slopes_are_derivatives_by_the_logarithms() -> None:
    (slope,) = MODEL.slopes(["sigma_0"], ["V_min", "P_max"], 0.05)
    up, down = MODEL.observe_all([{"sigma_0": 150e3 * np.exp(sign * 0.05)} for sign in (1.0, -1.0)])
    assert slope == pytest.approx([(up[name] - down[name]) / 0.1 for name in ("V_min", "P_max")])
    assert slope[0] < 0.0 < slope[1]
    with pytest.raises(ValueError, match="beat"):
        MODEL.slopes(["sigma_0"], ["V_min"], 7.0)
