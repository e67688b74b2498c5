"""The simulator itself: what locking tetrahedra get wrong is laid to the element and not to the patient."""

from collections.abc import Mapping

import numpy as np
import pytest

from heartfit.beat import Beat
from heartfit.configuration.generator import Pressures
from heartfit.configuration.numerics import TimeScheme
from heartfit.configuration.setting import Setting
from heartfit.geometry.mesh import VentricularMesh
from heartfit.observation.beat import beat_curves
from heartfit.proof.extension import Extension
from heartfit.proof.model import Model
from heartfit.proof.noise import covariance
from heartfit.proof.refit import Refit, Target, refit
from heartfit.proof.target import MeasuredCase

LOCKING = Setting.model_validate(
    {"element": "p1", "estimate": ("sigma_0",), "prior": {"sigma_0": {"mean": 240e3}}}
).with_prior({})
PARAMETERS = {"sigma_0": 255e3}
RIVALS = {
    "none": Extension(LOCKING),
    "element": Extension(LOCKING, element="mixed"),
    "leak": Extension.by(LOCKING, "MitralRegurgitation"),
}


@pytest.fixture(scope="module")
def refits(ventricle: VentricularMesh) -> Mapping[str, Refit]:
    scheme = TimeScheme(time_step=0.02, max_beats=2, drift=0.02)
    model = Model(ventricle, 0.8, Pressures(lv=1000.0, rv=500.0), scheme)
    target = _target(model(RIVALS["element"], PARAMETERS))
    return {name: refit(extension, model, target, 4) for name, extension in RIVALS.items()}


def _target(beat: Beat) -> Target:
    rng, curves = np.random.default_rng(3), beat_curves(beat)
    volume, pressure = (curves[name].resampled(25) for name in ("lv_volume", "lv_pressure"))
    volume = type(volume)(volume.times, volume.values + 1e-6 * rng.standard_normal(25), volume.period)
    pressure = type(volume)(pressure.times, pressure.values + 100.0 * rng.standard_normal(25), volume.period)
    case = MeasuredCase.of({"lv_volume": volume, "lv_pressure": pressure}, [])
    return Target(case.split.fitted, covariance(case.split.fitted, case.raw, []))


def test_the_element_is_named_and_no_leak(refits: Mapping[str, Refit]) -> None:
    evidence = {name: found.log_evidence - refits["none"].log_evidence for name, found in refits.items()}
    assert evidence["element"] > 5.0
    assert evidence["element"] > evidence["leak"] + 5.0


def test_with_the_right_element_the_parameter_is_found(refits: Mapping[str, Refit]) -> None:
    assert refits["element"].parameters["sigma_0"] == pytest.approx(PARAMETERS["sigma_0"], rel=0.05)
    assert refits["none"].parameters["sigma_0"] > 1.15 * PARAMETERS["sigma_0"]
