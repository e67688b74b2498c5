"""Which parameters are tried about the prior's mean, and of which heart."""

from pathlib import Path

import pytest

from heartfit.configuration.setting import Prior, Setting
from heartfit.configuration.strict import validated
from heartfit.configuration.study import Study
from heartfit.errors import InputError
from heartfit.heart import FOURTEEN
from heartfit.io.configuration import read_configuration, read_study
from heartfit.io.plan import plan_study

ROOT = Path(__file__).parents[2]
CONFIG = ROOT / "config" / "config.yaml"


def test_all_fourteen_surround_the_prior_of_each_setting_by_one_deviation():
    study = read_study([CONFIG])
    prior = study.surroundings("paper").gaussian()
    assert prior.names == FOURTEEN
    assert prior.physical()["K"] == pytest.approx(study.settings["paper"].prior["K"].mean)
    assert study.surroundings("physical").gaussian().physical()["K"] == pytest.approx(1e6)
    assert study.sensitivity.scaling().spread(14) == pytest.approx(study.sensitivity.step**2)


def test_the_sphere_has_its_own_contractility_and_else_the_same_prior():
    study = read_study([CONFIG])
    sphere = study.sphere().gaussian().physical()
    assert sphere["sigma_0"] == pytest.approx(study.sensitivity.sphere.heart["sigma_0"])
    assert sphere["mu"] == pytest.approx(study.prior["mu"].mean)
    assert study.sphere().base_heart(0.9).tissue.element == "sphere"


def test_what_a_setting_fixes_is_the_mean_where_it_is_freed():
    setting = Setting(element="mixed", estimate=("mu",), heart={"alpha": 6.0, "slope": 0.3})
    freed = setting.estimating(("alpha", "mu"))
    assert freed.heart == {"slope": 0.3}
    assert freed.prior["alpha"] == Prior(mean=6.0)
    assert freed.with_prior({}).gaussian().physical()["alpha"] == pytest.approx(6.0)


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"sphere": {"samples": 100}}, "expected a power of two"),
        ({"parameters": ["sigma_0"] * 6}, "at least 7"),
        ({"parameters": ["sigma_0", "mu", "c_1", "R_p", "K", "alpha", "beta"]}, "beta"),
    ],
)
def test_what_cannot_be_is_refused(change, expected):
    content = read_configuration([CONFIG])
    content["sensitivity"] |= change
    with pytest.raises(InputError, match=expected):
        validated(Study, content, "config.yaml")


def test_the_reference_must_be_a_case_that_can_be_run(monkeypatch):
    monkeypatch.chdir(ROOT)
    content = read_configuration([CONFIG])
    content["sensitivity"]["case"] = "volunteer9"
    with pytest.raises(InputError, match=r"'volunteer9' is no case that can be run; known are .*volunteer1"):
        plan_study(content)
