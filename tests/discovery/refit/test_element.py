"""Discretisation errors of locking tetrahedra are attributed to the element and not to the patient."""

from collections.abc import Mapping

import numpy as np
import pytest

from heartfit.discovery.refit.model import Model
from heartfit.discovery.refit.target import MeasuredCase
from heartfit.geometry.mesh import VentricularMesh
from heartfit.heart.beat import Beat
from heartfit.observation.beat import beat_curves
from heartfit.personalise.numerics import Pressures, TimeScheme
from heartfit.personalise.setting import Setting
from heartfit.results.element import element_table
from heartfit.synthetic.element import CompetingModel, compare_extensions, competing_extensions

LOCKING = Setting.model_validate(
    {"element": "p1", "estimate": ("sigma_0",), "prior": {"sigma_0": {"mean": 240e3}}}
).with_prior({})
PARAMETERS = {"sigma_0": 255e3}
NONE, ELEMENT, LEAK = competing_extensions(LOCKING, "mixed", "MitralRegurgitation")


pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def comparisons(ventricle: VentricularMesh) -> Mapping[str, CompetingModel]:
    scheme = TimeScheme(time_step=0.02, max_beats=1, drift=0.99)
    model = Model(ventricle, 0.8, Pressures(lv=1000.0, rv=500.0), scheme)
    extensions = competing_extensions(LOCKING, "mixed", "MitralRegurgitation")
    case = _measured(model(extensions[ELEMENT], PARAMETERS))
    return {comparison.name: comparison for comparison in compare_extensions(case, model, extensions, 4)}


def _measured(beat: Beat) -> MeasuredCase:
    rng, curves = np.random.default_rng(3), beat_curves(beat)
    volume, pressure = (curves[name].resampled(25) for name in ("lv_volume", "lv_pressure"))
    volume = type(volume)(volume.times, volume.values + 1e-6 * rng.standard_normal(25), volume.period)
    pressure = type(volume)(pressure.times, pressure.values + 100.0 * rng.standard_normal(25), volume.period)
    return MeasuredCase.from_curves({"lv_volume": volume, "lv_pressure": pressure}, [])


def test_the_element_is_preferred_to_a_leak(comparisons: Mapping[str, CompetingModel]) -> None:
    factors = dict(
        zip(comparisons, element_table([*comparisons.values()], PARAMETERS)["ln Bayes factor"], strict=True)
    )
    assert factors[NONE] == 0.0
    assert factors[ELEMENT] > 5.0
    assert factors[ELEMENT] > factors[LEAK] + 5.0


def test_the_right_element_gains_on_held_out_data(comparisons: Mapping[str, CompetingModel]) -> None:
    assert not comparisons[NONE].gains
    assert all(gain.ratio < 0.8 for gain in comparisons[ELEMENT].gains)


def test_with_the_right_element_the_parameter_is_found(comparisons: Mapping[str, CompetingModel]) -> None:
    assert comparisons[ELEMENT].parameters["sigma_0"] == pytest.approx(PARAMETERS["sigma_0"], rel=0.05)
    assert comparisons[NONE].parameters["sigma_0"] > 1.15 * PARAMETERS["sigma_0"]
