"""A sound heart whose valves obey another law is explained to within its noise in every curve, the right volume too."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
import pytest

from heartfit.discovery.refit.extension import RIGHT_PARAMETERS, Extension
from heartfit.discovery.refit.goodness import curve_fits
from heartfit.discovery.refit.refit import refit
from heartfit.discovery.refit.target import MeasuredCase, sample, stack
from heartfit.discovery.sphere_model.free_parameters import HEART_PARAMETERS
from heartfit.heart.beat import Beat
from heartfit.heart.circulation.elements import OrificeValve
from heartfit.heart.heart import Heart
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.personalise.setting import Setting
from heartfit.synthetic.volunteer import VALVES
from tests.discovery.refit.one_by_one import OneByOne

PERIOD = 0.86
SPHERES = [Sphere.from_volumes(110e-6, 120e-6), Sphere.from_volumes(120e-6, 45e-6)]
PLAIN = Setting.model_validate(
    {"element": "sphere", "estimate": ("sigma_0", "mu"), "prior": {"sigma_0": {"mean": 190e3}}}
).with_prior({})
NOISE = {"lv_volume": 0.3e-6, "rv_volume": 0.3e-6, "lv_pressure": 100.0}
SAMPLES = {"lv_volume": 25, "rv_volume": 25, "lv_pressure": 200}
SAME_PLACE = {
    "systemic": "pulmonary_tree",
    "mitral": "tricuspid",
    "aortic": "pulmonary",
    "left_atrium": "right_atrium",
}


OTHER_VALVES = replace(VALVES, pulmonary=OrificeValve(area=2.2e-4))
"""The pulmonary orifice takes a large share of the right pressure at the peak of its flow, as no conductance does."""


def beat_of(heart: Heart) -> Beat:
    return simulate_spheres(heart, SPHERES, Numerics(time_step=5e-3, max_beats=8, drift=1e-3))


@OneByOne
def run(extension: Extension, parameters: Mapping[str, float]) -> Beat:
    return beat_of(extension.setting.base_heart(PERIOD).with_parameters(parameters))


def measured(seed: int) -> MeasuredCase:
    rng, plain = np.random.default_rng(seed), Extension(PLAIN)
    heart = PLAIN.base_heart(PERIOD).with_parameters(plain.parameters(np.array([0.5, -0.5])))
    curves = beat_curves(beat_of(replace(heart, circulation=OTHER_VALVES)))
    noisy: dict[str, Curve] = {}
    for name, count in SAMPLES.items():
        curve = curves[name].resampled(count)
        noisy[name] = replace(curve, values=curve.values + NOISE[name] * rng.standard_normal(count))
    return MeasuredCase.from_curves(noisy, [])


@pytest.mark.parametrize("seed", [11, 12, 13])
def test_a_sound_heart_with_other_valves_is_explained_in_every_curve(seed: int) -> None:
    case, baseline = measured(seed), Extension(PLAIN).with_free_parameters(True)
    fit = refit(baseline, run, case.target, case.complete_target, 20)
    shown = beat_curves(run(baseline, fit.parameters))
    predicted = stack(sample(shown, case.complete_target.samples))
    fits = {one.curve: one.p for one in curve_fits(fit, case.target, case.complete_target, predicted)}
    assert fits.keys() == SAMPLES.keys()
    assert min(fits.values()) > 0.01


@pytest.mark.parametrize("part", SAME_PLACE)
def test_what_is_free_of_the_left_circulation_is_free_of_the_right_one(part: str) -> None:
    """But for the peripheral resistance, which a volume alone does not show."""
    left = [path for one in HEART_PARAMETERS for path in one.paths if path.startswith(f"circulation.{part}")]
    right = {path for one in RIGHT_PARAMETERS for path in one.paths}
    expected = {path.replace(part, SAME_PLACE[part]) for path in left if not path.endswith("R_p")}
    assert expected
    assert expected <= right
