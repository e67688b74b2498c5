"""The right ventricle of the search: its sphere, its free parameters, and the balance of both sides."""

from dataclasses import replace

import numpy as np
import pytest

from heartfit.discovery.sphere_model import limits
from heartfit.discovery.sphere_model.forward_model import NUMERICS, SphereForwardModel, hypothesis
from heartfit.discovery.sphere_model.free_parameters import FREE_PARAMETERS, RIGHT_FREE_PARAMETERS
from heartfit.discovery.sphere_model.limits import LEFT_CURVES, detection_limits
from heartfit.discovery.sphere_model.nominal_heart import ADULT, WITH_RIGHT
from heartfit.discovery.sphere_model.problem import SphereProblem
from heartfit.discovery.sphere_model.recording import BALANCE, BALANCE_SD, Recording, Samples, search_data
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation
from heartfit.mechanisms.tricuspid_regurgitation import TricuspidRegurgitation
from heartfit.roles import Mechanism
from heartfit.roles.sides import net_inflow

PERIOD = WITH_RIGHT.heart.period
FRAMES, SAMPLED = np.arange(28) * PERIOD / 28, np.arange(80) * PERIOD / 80
TIMES = {"lv_volume": FRAMES, "lv_pressure": SAMPLED, "rv_volume": FRAMES, BALANCE: np.zeros(1)}
CENTRE = np.zeros(len(FREE_PARAMETERS) + len(RIGHT_FREE_PARAMETERS))

WITH_RIGHT_PRESSURE = 500.0 + 2e3 * np.sin(np.pi * SAMPLED / PERIOD) ** 2


def curves(x: np.ndarray = CENTRE, *effects: Mechanism) -> dict[str, np.ndarray]:
    predicted = SphereForwardModel(WITH_RIGHT, TIMES).predict(x, effects)
    assert predicted is not None
    ends = np.cumsum([times.size for times in TIMES.values()])
    return dict(zip(TIMES, np.split(predicted, ends[:-1]), strict=True))


def recording() -> Recording:
    at_centre = curves()
    samples = {name: Samples(TIMES[name], at_centre[name]) for name in TIMES if name != BALANCE}
    return Recording(PERIOD, samples).with_both_ventricles()


def test_the_adult_with_a_right_ventricle_is_the_adult_and_pumps_one_volume_on_both_sides() -> None:
    left, both = (heart.beat(NUMERICS) for heart in (ADULT, WITH_RIGHT))
    assert both.volume["lv"] == pytest.approx(left.volume["lv"], abs=1e-12)
    inflow = net_inflow(both.flow, WITH_RIGHT.heart.mechanisms)
    assert inflow["pulmonary_artery"] * PERIOD == pytest.approx(-inflow["left_atrium"] * PERIOD, abs=0.5e-6)
    assert inflow["rv"] == pytest.approx(0.0, abs=1e-9)
    assert np.ptp(both.volume["rv"]) / both.volume["rv"].max() == pytest.approx(0.58, abs=0.03)
    assert both.pressure["rv"].max() == pytest.approx(2.8e3, rel=0.1)


def test_every_free_parameter_of_the_right_side_acts_on_it_and_not_on_the_left_one() -> None:
    centre = curves()
    for index in range(len(FREE_PARAMETERS), CENTRE.size):
        changed = curves(np.where(np.arange(CENTRE.size) == index, 1.0, 0.0))
        assert np.abs(changed["rv_volume"] - centre["rv_volume"]).max() > 2e-8, WITH_RIGHT.free[index].name
        assert changed["lv_volume"] == pytest.approx(centre["lv_volume"], abs=1e-11)


def test_the_gain_of_the_images_scales_the_right_volume_alone() -> None:
    gain = [parameter.name for parameter in WITH_RIGHT.free].index("right_gain")
    shown, true = curves(np.where(np.arange(CENTRE.size) == gain, 1.0, 0.0)), curves()
    assert shown["rv_volume"] == pytest.approx(np.exp(0.1) * true["rv_volume"])
    for name in ("lv_volume", "lv_pressure", BALANCE):
        assert shown[name] == pytest.approx(true[name], rel=1e-6, abs=1e-12)


@pytest.mark.parametrize(
    ("effect", "sign"), [(MitralRegurgitation(0.3e-4), -1.0), (TricuspidRegurgitation(0.4e-4), 1.0)]
)
def test_a_regurgitation_of_one_side_unbalances_the_sides_by_the_volume_it_keeps_from_the_artery(
    effect: Mechanism, sign: float
) -> None:
    """The leak of the left side takes from what its atrium loses; that of the right one from the pulmonary artery."""
    lost = curves(CENTRE, effect)[BALANCE][0] - curves()[BALANCE][0]
    assert 10e-6 < sign * lost < 45e-6


def test_balanced_sides_are_data_of_the_searched_half_alone() -> None:
    first, second = recording().halves()
    assert second is not None
    assert "rv_volume" in first.searched
    assert "rv_volume" in second.searched
    *_, balance = search_data(first).blocks
    assert balance.curve == BALANCE
    assert balance.noise.levels == (pytest.approx(BALANCE_SD * first.end_diastolic_volume()),)
    assert BALANCE not in {block.curve for block in search_data(second).blocks}


def test_a_right_pressure_is_data_with_the_errors_of_a_smaller_one() -> None:
    pressure = Samples(SAMPLED, WITH_RIGHT_PRESSURE)
    both = replace(recording(), curves=recording().curves | {"rv_pressure": pressure})
    blocks = {block.curve: block for block in search_data(both).blocks}
    assert blocks["rv_pressure"].noise.levels == blocks["lv_pressure"].noise.levels
    assert blocks["rv_pressure"].noise.roughness == pytest.approx(0.3 * blocks["lv_pressure"].noise.roughness)
    assert "rv_pressure" not in Recording(PERIOD, both.curves).searched


def test_without_a_left_pressure_the_right_volume_is_not_searched() -> None:
    volumes = {name: recording().curves[name] for name in ("lv_volume", "rv_volume")}
    alone = Recording(PERIOD, volumes).with_both_ventricles()
    assert alone.searched == ("lv_volume",)
    assert not alone.balanced


def test_the_nominal_heart_has_the_size_of_both_recorded_ventricles() -> None:
    wide = replace(
        recording(),
        curves=recording().curves
        | {"rv_volume": Samples(FRAMES, 1.3 * recording().curves["rv_volume"].values)},
    )
    nominal = SphereProblem.from_recording(wide).model.nominal
    assert nominal.cavity == pytest.approx(ADULT.cavity, rel=0.02)
    assert nominal.right is not None
    assert WITH_RIGHT.right is not None
    assert nominal.right.cavity == pytest.approx(1.3 * WITH_RIGHT.right.cavity, rel=0.02)
    resistance = "circulation.pulmonary_tree.R_p"
    assert nominal.values[resistance] == pytest.approx(WITH_RIGHT.values[resistance] / 1.3, rel=0.02)


def test_coordinates_of_a_place_or_a_mechanism_follow_those_of_both_sides() -> None:
    model = SphereForwardModel(WITH_RIGHT, TIMES)
    assert hypothesis(model).names == tuple(parameter.name for parameter in WITH_RIGHT.free)
    assert (
        hypothesis(SphereForwardModel(ADULT, TIMES)).names == hypothesis(model).names[: len(FREE_PARAMETERS)]
    )


def test_a_right_volume_adds_to_the_evidence_expected_for_an_aortic_regurgitation(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """At two scales."""
    monkeypatch.setattr(limits, "SIZES", (2.0,))
    left, both = (
        next(detection_limits(1, nominal, ("AorticRegurgitation",), curves=curves))
        for nominal, curves in ((ADULT, LEFT_CURVES), (WITH_RIGHT, (*LEFT_CURVES, "rv_volume")))
    )
    assert both.factors[0] > left.factors[0] + 5.0
