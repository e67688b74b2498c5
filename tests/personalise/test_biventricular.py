"""Calibration of both ventricles: observations of the right one find its planted parameters on two spheres."""

import numpy as np
import pytest

from heartfit.calibration.unscented import SigmaPoint, sigma_points
from heartfit.core.errors import InputError
from heartfit.heart.beat import Beat
from heartfit.heart.simulation import Numerics
from heartfit.heart.sphere.body import Sphere
from heartfit.heart.sphere.simulation import simulate_spheres
from heartfit.io.configuration import read_cases, read_configuration, schema
from heartfit.io.plan import plan_study
from heartfit.observation.beat import beat_curves
from heartfit.observation.curve import Curve
from heartfit.observation.measurement import observe_measured
from heartfit.personalise.numerics import Operator, Transform
from heartfit.personalise.run import estimate, observe_plausibility
from heartfit.personalise.setting import Prior, Setting
from heartfit.study.study import Study
from tests.checkout import ROOT

PERIOD = 0.85
RIGHT = ("tissue.right.contractility", "tissue.right.delay", "circulation.pulmonary_tree.R_p")
OPERATOR = Operator(frames=25, window=3, order=2, period_uncertainty=0.0)
NUMERICS = Numerics(time_step=5e-3, max_beats=20, drift=2e-4)
BOTH = Setting(
    element="sphere",
    estimate=("sigma_0", "mu", "c_1", "R_p", *RIGHT),
    observe=("rv_volume",),
    prior={"sigma_0": Prior(mean=150e3), "tissue.right.delay": Prior(mean=0.02)},
).with_prior({})
TRUTH = {"sigma_0": 165e3, "R_p": 1.15e8, RIGHT[0]: 0.7, RIGHT[1]: 0.035, RIGHT[2]: 1.9e7}


@pytest.fixture
def config() -> dict:
    return read_configuration([ROOT / "config" / name for name in ("config.yaml", "full.yaml")])


def beat_of(parameters: dict[str, float]) -> Beat:
    spheres = [Sphere.from_volumes(100e-6, 130e-6), Sphere.from_volumes(110e-6, 45e-6)]
    return simulate_spheres(BOTH.base_heart(PERIOD).with_parameters(parameters), spheres, NUMERICS)


@pytest.fixture(scope="module")
def measured() -> dict[str, Curve]:
    curves = beat_curves(beat_of(BOTH.gaussian().physical() | TRUTH))
    return {name: curves[name].resampled(25) for name in ("lv_volume", "rv_volume")}


@pytest.fixture(scope="module")
def simulated() -> tuple[list[SigmaPoint], list[Beat]]:
    points = sigma_points(BOTH.gaussian())
    return points, [beat_of(point.parameters) for point in points]


def test_the_right_volume_has_observations_of_its_own(measured: dict[str, Curve]) -> None:
    left, both = (OPERATOR.features(measured, also) for also in ((), ("rv_volume",)))
    assert list(left) == ["lv_volume"]
    assert both["lv_volume"] == left["lv_volume"]
    right, same = both["rv_volume"](measured["rv_volume"]), left["lv_volume"](measured["rv_volume"])
    assert list(right) == ["V_min_rv", "q_max_rv", "q_min_rv"]
    assert list(right.values()) == list(same.values())
    with pytest.raises(ValueError, match="rv_volume"):
        OPERATOR.features({"lv_volume": measured["lv_volume"]}, ("rv_volume",))


def test_planted_parameters_of_the_right_ventricle_are_recovered(
    measured: dict[str, Curve], simulated: tuple[list[SigmaPoint], list[Beat]]
) -> None:
    """Six independent directions, of which three are weak: peak rates hardly see a delay or a resistance."""
    prior = BOTH.gaussian()
    measurement = observe_measured(measured, OPERATOR.features(measured, BOTH.observe), 0.0)
    arguments = (BOTH, prior, *simulated, measured, measurement, OPERATOR, Transform())
    posterior = estimate(*arguments)
    assert not posterior.failed
    assert posterior.singular_values == pytest.approx([2.08, 1.01, 0.60, 0.045, 0.024, 0.009], rel=0.1)
    planted = np.log([TRUTH[name] for name in RIGHT]) - prior.mean[-3:]
    errors = np.abs(posterior.estimate.mean[-3:] - prior.mean[-3:] - planted)
    assert (errors < np.abs(planted)).all()
    assert errors[0] < 0.25 * abs(planted[0])
    shrunk = (posterior.estimate.sd / prior.sd)[-3:]
    assert shrunk[0] < 0.5 < 0.9 < shrunk[1:].min()


def test_a_setting_may_ask_for_the_noise_of_its_observations(
    measured: dict[str, Curve], simulated: tuple[list[SigmaPoint], list[Beat]]
) -> None:
    measurement = observe_measured(measured, OPERATOR.features(measured, BOTH.observe), 0.0)
    noisy = BOTH.model_copy(update={"noise": True})
    steps = [
        estimate(setting, BOTH.gaussian(), *simulated, measured, measurement, OPERATOR, transform).step
        for setting, transform in ((noisy, Transform()), (BOTH, Transform(noise=True)), (BOTH, Transform()))
    ]
    assert (steps[0] == steps[1]).all()
    assert abs(steps[0] - steps[2]).max() > 0.01


def test_without_the_right_volume_the_right_parameters_keep_their_prior(
    measured: dict[str, Curve], simulated: tuple[list[SigmaPoint], list[Beat]]
) -> None:
    """No blood of the right ventricle reaches the left one in this circuit."""
    alone = BOTH.model_copy(update={"observe": ()})
    measurement = observe_measured(measured, OPERATOR.features(measured, BOTH.observe), 0.0)
    arguments = (alone, alone.gaussian(), *simulated, measured, measurement, OPERATOR, Transform())
    posterior = estimate(*arguments)
    assert posterior.observations == ("V_min", "q_max", "q_min")
    steps = posterior.step[[posterior.prior.names.index(name) for name in RIGHT]]
    assert abs(steps).max() < 0.05


def test_sensitivities_cover_both_ventricles(simulated: tuple[list[SigmaPoint], list[Beat]]) -> None:
    points, beats = (part[:2] for part in simulated)
    assert {"V_min", "q_min", "V_min_rv", "q_min_rv", "EDV"} <= observe_plausibility(  # type: ignore[operator]
        BOTH, points, beats, OPERATOR
    )[0].keys()


def test_a_parameter_of_zero_needs_a_median() -> None:
    blank = BOTH.model_copy(update={"prior": {}})
    with pytest.raises(ValueError, match=r"tissue\.right\.delay .* zero"):
        blank.with_prior({})
    assert blank.with_prior({"tissue.right.delay": Prior(mean=0.01)}).prior["tissue.right.delay"].mean == 0.01


def test_the_study_fits_both_ventricles_of_the_measured_heart_alone(config: dict) -> None:
    study = Study.model_validate(config)
    cases = {case.case: case for case in read_cases(ROOT / study.cases)}
    assert study.settings_of(cases["patient1"]) == ("locking", "physical", "locking_twice", "biventricular")
    assert study.settings_of(cases["volunteer1"]) == study.common_settings() == ("locking", "physical")
    assert study.curves_besides(cases["patient1"]) == ("rv_volume",)
    assert study.curves_besides(cases["volunteer1"]) == ()
    assert study.perturbed_as("biventricular") == "physical"
    assert "observe" in str(schema())


def test_settings_of_some_cases_come_last_in_whichever_order_files_state_them(config: dict) -> None:
    """Snakemake puts those of a file given with --configfile first."""
    config["settings"] = dict(reversed(config["settings"].items()))
    study = Study.model_validate(config)
    assert [study.settings[name].cases is None for name in study.settings] == [True, True, False, False]
    assert study.perturbed_as("locking_twice") == "locking"


def test_a_right_volume_of_virtual_images_is_refused(config: dict, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its errors are in no noise model."""
    monkeypatch.chdir(ROOT)
    del config["settings"]["biventricular"]["cases"]
    with pytest.raises(InputError, match="biventricular observes rv_volume"):
        plan_study(config)


def test_one_setting_is_for_all_cases(config: dict) -> None:
    for setting in config["settings"].values():
        setting["cases"] = ["patient1"]
    with pytest.raises(ValueError, match="expected one for all cases"):
        Study.model_validate(config)
