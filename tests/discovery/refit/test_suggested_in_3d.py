"""A mechanism that a search suggests is refitted in the three-dimensional heart."""

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from heartfit.cli.diagnose import run_mechanism_files
from heartfit.discovery.refit.extension import Extension
from heartfit.discovery.refit.model import Model, activate
from heartfit.discovery.refit.refit import refit
from heartfit.discovery.refit.target import MeasuredCase, Target, covariance
from heartfit.discovery.sphere_model.cause import ActingPlace, Diagnosis, RankedLaw
from heartfit.geometry.mesh import VentricularMesh
from heartfit.observation.beat import beat_curves
from heartfit.personalise.numerics import Pressures, TimeScheme
from heartfit.personalise.setting import Setting
from heartfit.results.mechanism_file import mechanism_file
from heartfit.roles.registry import _REGISTRY

AREA, PERIOD = 0.4e-4, 0.8
SETTING = Setting.model_validate({"element": "mixed", "estimate": ("sigma_0", "R_p")}).with_prior({})
MOST_STEPS = 8


@pytest.fixture
def suggested(tmp_path: Path) -> Iterator[str]:
    """Name of the mechanism of the file for a leak that follows the law of an orifice of 0.2 cm²."""
    law = RankedLaw("orifice", "", 0.2e-4, "m^2", 0.0, {})
    acting = ActingPlace("leak", "LeakPassage", "a flow out of the left ventricle", 12.0, (), (law,))
    unknown = Diagnosis("unknown", (), (), "", (), 1, PERIOD, 5.0, acting=(acting,))
    path = tmp_path / "suggested.py"
    path.write_text(mechanism_file(unknown, "patient"))
    (name,) = run_mechanism_files([path])
    yield name
    _REGISTRY.pop(name)


def noisy_case(model: Model, true: dict[str, float]) -> MeasuredCase:
    """Volume at 25 times and pressure at 200 of a heart with mitral regurgitation, with white noise."""
    curves = beat_curves(model(Extension.from_names(SETTING, "MitralRegurgitation"), true))
    rng = np.random.default_rng(11)
    measured = {}
    for name, count, noise in (("lv_volume", 25, 0.5e-6), ("lv_pressure", 200, 100.0)):
        curve = curves[name].resampled(count)
        measured[name] = replace(curve, values=curve.values + noise * rng.standard_normal(count))
    return MeasuredCase.from_curves(measured, [])


@pytest.mark.long
def test_a_refit_of_a_suggested_leak_gives_the_hidden_regurgitation(
    suggested: str, ventricle: VentricularMesh
) -> None:
    scheme = TimeScheme(time_step=0.01, second_order=True, max_beats=6, drift=1e-3)
    model = Model(activate(ventricle), PERIOD, Pressures(lv=1.2e3, rv=0.5e3), scheme)
    plain, extension = Extension(SETTING), Extension.from_names(SETTING, suggested)
    nominal = plain.parameters(plain.start())
    true = {"sigma_0": 1.1 * nominal["sigma_0"], "R_p": 0.9 * nominal["R_p"]}
    case = noisy_case(model, nominal | true | {"MitralRegurgitation.area": AREA})
    target = Target(case.split.fitted, covariance(case.split.fitted, case.raw, []))
    without, extended = (refit(one, model, target, target, MOST_STEPS) for one in (plain, extension))
    assert extended.log_evidence > without.log_evidence + 10.0
    assert extended.parameters[extension.names[-1]] == pytest.approx(AREA, rel=0.1)
    for name, value in true.items():
        assert extended.parameters[name] == pytest.approx(value, rel=0.1)
