"""Parameters perturbed about the prior's mean, and the heart that is perturbed."""

from pathlib import Path

import pytest

from heartfit.core.errors import InputError
from heartfit.core.validation import validate
from heartfit.heart.heart import PAPER_PARAMETERS
from heartfit.io.configuration import read_configuration, read_study
from heartfit.io.plan import plan_study
from heartfit.personalise.setting import Prior, Setting
from heartfit.study.study import Study

ROOT = Path(__file__).parents[2]
CONFIG = ROOT / "config" / "config.yaml"


def test_all_fourteen_parameters_are_perturbed_by_one_prior_deviation():
    study = read_study([CONFIG])
    prior = study.perturbation_setting("locking").gaussian()
    assert prior.names == PAPER_PARAMETERS
    assert prior.physical()["K"] == pytest.approx(study.settings["locking"].prior["K"].mean)
    assert study.perturbation_setting("physical").gaussian().physical()["K"] == pytest.approx(1e6)
    assert study.sensitivity.scaling().spread(14) == pytest.approx(study.sensitivity.step**2)


def test_the_sphere_has_its_own_contractility_and_else_the_same_prior():
    study = read_study([CONFIG])
    sphere = study.sphere_setting().gaussian().physical()
    assert sphere["sigma_0"] == pytest.approx(study.sensitivity.sphere.heart["sigma_0"])
    assert sphere["mu"] == pytest.approx(study.prior["mu"].mean)
    assert study.sphere_setting().base_heart(0.9).tissue.element == "sphere"


def test_a_fixed_value_is_the_prior_mean_of_the_freed_parameter():
    setting = Setting(element="mixed", estimate=("mu",), heart={"alpha": 6.0, "slope": 0.3})
    freed = setting.with_estimated(("alpha", "mu"))
    assert freed.heart == {"slope": 0.3}
    assert freed.prior["alpha"] == Prior(mean=6.0)
    assert freed.with_prior({}).gaussian().physical()["alpha"] == pytest.approx(6.0)


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"sphere": {"samples": 100}}, "samples = 100|100.*power of two"),
        ({"parameters": ["sigma_0"] * 6}, "at least 7"),
        ({"parameters": ["sigma_0", "mu", "c_1", "R_p", "K", "alpha", "beta"]}, "beta"),
    ],
)
def test_inadmissible_configurations_are_refused(change, expected):
    content = read_configuration([CONFIG])
    content["sensitivity"] |= change
    with pytest.raises(InputError, match=expected):
        validate(Study, content, "config.yaml")


def test_the_reference_must_be_a_case_that_can_be_run(monkeypatch):
    monkeypatch.chdir(ROOT)
    content = read_configuration([CONFIG])
    content["sensitivity"]["case"] = "volunteer9"
    with pytest.raises(InputError, match=r"'volunteer9'.*volunteer1"):
        plan_study(content)
