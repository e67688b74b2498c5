"""Parameters are declared once; inadmissible values are refused by name."""

from dataclasses import FrozenInstanceError, dataclass

import pytest

from heartfit.calibration.gaussian import Gaussian
from heartfit.core.parameter import Parameter, parameter, parameters_of, require_admissible
from heartfit.heart.circulation.elements import Windkessel
from heartfit.heart.heart import Heart
from heartfit.heart.muscle.passive import MooneyRivlin


@dataclass(frozen=True)
class Part:
    size: float = parameter(2.0, unit="m", symbol="s", meaning="size of the part", sd=0.1, low=-1.0)
    label: str = "not a parameter"

    def __post_init__(self) -> None:
        require_admissible(self)


def test_a_declaration_is_read_from_the_class_and_its_value_from_the_instance() -> None:
    (declared,) = parameters_of(Part)
    assert (declared.name, declared.unit, declared.symbol, declared.sd, declared.low) == (
        "size", "m", "s", 0.1, -1.0,
    )  # fmt: skip
    assert declared.value == 2.0
    assert next(parameters_of(Part(size=3.0))).value == 3.0


@pytest.mark.parametrize("value", [-1.1, float("nan"), float("inf"), float("-inf")])
def test_an_inadmissible_value_is_refused_with_name_unit_and_bound(value: float) -> None:
    with pytest.raises(ValueError, match=r"Part\.size = \S+ m.*-1 \(size"):
        Part(size=value)


def test_the_bound_itself_is_admissible() -> None:
    assert Part(size=-1.0).size == -1.0


@pytest.mark.parametrize("part", [MooneyRivlin, Windkessel])
def test_the_parts_of_the_heart_refuse_negative_parameters(part: type) -> None:
    for declared in parameters_of(part):
        with pytest.raises(ValueError, match=rf"{part.__name__}\.{declared.name} = -1 "):
            part(**{declared.name: -1.0})


def test_values_do_not_change_in_place() -> None:
    for part, name in ((MooneyRivlin(), "c_1"), (Windkessel(), "R_p"), (next(parameters_of(Part)), "value")):
        with pytest.raises(FrozenInstanceError):
            setattr(part, name, 4.0)


def test_every_calibrated_parameter_has_a_prior_around_an_admissible_value() -> None:
    heart = Heart()
    for part in (heart.tissue.passive, heart.tissue.active, heart.tissue.control, heart.circulation.systemic):
        for declared in parameters_of(part):
            if declared.sd is not None:
                assert 0.0 < declared.sd < 1.0
                assert declared.value > max(declared.low, 0.0)


def test_a_search_takes_a_switch_about_off_and_another_parameter_about_its_value() -> None:
    switch = Parameter("leak", 3.0, "m^2", "A", "a leak", off=1.0, low=1.0, scale=0.5)
    signed = Parameter("late", 3.0, "s", "d", "a delay", off=0.0, low=-1.0, scale=0.5)
    place = Parameter("angle", 3.0, "rad", "a", "where", low=-9.0, scale=0.5)
    assert [switch.at(x) for x in (-1.0, 0.0, 2.0)] == [1.0, 1.0, 2.0]
    assert [signed.at(x) for x in (-1.0, 0.0, 2.0)] == [-0.5, 0.0, 1.0]
    assert [place.at(x) for x in (-1.0, 0.0, 2.0)] == [2.5, 3.0, 4.0]
    assert [declared.one_sided for declared in (switch, signed, place)] == [True, False, False]


def test_a_search_takes_a_prior_as_a_calibration_does() -> None:
    modulus = Parameter("c", 3.0, "Pa", "c", "a modulus", sd=0.2)
    belief = Gaussian.from_relative({"c": 3.0}, {"c": 0.2})
    for x in (-1.0, 0.0, 1.5):
        assert modulus.at(x) == pytest.approx(belief.physical(belief.mean + x * belief.sd)["c"])


def test_a_parameter_without_scale_and_prior_cannot_be_searched() -> None:
    with pytest.raises(ValueError, match=r"\bK\b.*\bscale\b.*\bsd\b"):
        Parameter("K", 1.0, "Pa", "K", "a modulus").at(0.0)
