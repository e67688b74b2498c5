"""The composition root: parameters by name, mechanisms by addition."""

import pytest

from heartfit.core.errors import InputError
from heartfit.heart.heart import PAPER_PARAMETERS, Heart
from heartfit.mechanisms.atrial_kick import AtrialKick
from heartfit.mechanisms.mitral_regurgitation import MitralRegurgitation


@pytest.mark.parametrize("name", PAPER_PARAMETERS)
def test_the_paper_s_parameters_go_by_their_short_names(name: str) -> None:
    heart = Heart()
    changed = heart.with_parameters({name: 1.25 * heart.parameters()[heart.parameter_path(name)]})
    different = {p for p, v in changed.parameters().items() if v != heart.parameters()[p]}
    assert different == {heart.parameter_path(name)}


def test_short_names_of_both_circulations_mean_the_systemic_one() -> None:
    heart = Heart().with_parameters({"R_p": 2e8, "circulation.pulmonary_tree.R_p": 3e7})
    assert (heart.circulation.systemic.R_p, heart.circulation.pulmonary_tree.R_p) == (2e8, 3e7)


def test_parameters_of_mechanisms_and_of_nested_parts_are_reached() -> None:
    heart = (Heart() + MitralRegurgitation()).with_parameters({"area": 3e-5, "rise": 900.0, "slope": 0.4})
    assert heart.mechanisms == (AtrialKick(rise=900.0), MitralRegurgitation(area=3e-5))
    assert heart.tissue.active.starling.slope == 0.4


def test_setting_all_parameters_to_their_values_changes_no_parameter() -> None:
    heart = Heart() + MitralRegurgitation()
    assert heart.with_parameters(heart.parameters()) == heart


def test_an_unknown_name_is_refused_with_the_nearest_known_one() -> None:
    with pytest.raises(KeyError, match=r"'sigma0'.*\['sigma_0'"):
        Heart().with_parameters({"sigma0": 1.0})


def test_an_ambiguous_name_is_refused_with_its_paths() -> None:
    with pytest.raises(KeyError, match=r"circulation\.mitral\.open.*circulation\.aortic\.open"):
        Heart().with_parameters({"open": 1e-6})


def test_an_inadmissible_value_is_refused() -> None:
    with pytest.raises(ValueError, match=r"Windkessel\.R_p = -1 "):
        Heart().with_parameters({"R_p": -1.0})


def test_a_mechanism_is_added_and_replaces_one_of_its_kind() -> None:
    heart = Heart() + MitralRegurgitation(area=1e-5) + MitralRegurgitation(area=2e-5)
    assert heart.mechanisms == (AtrialKick(), MitralRegurgitation(area=2e-5))
    assert Heart().mechanisms == (AtrialKick(),)


def test_the_trigger_is_counted_from_the_start_of_atrial_systole() -> None:
    heart = Heart().with_parameters({"onset": 0.2, "trigger_delay": 0.03})
    assert heart.trigger == pytest.approx(0.23)


@pytest.mark.parametrize(
    ("wrong", "text"), [(MitralRegurgitation, "class MitralRegurgitation"), ("Scar", "'Scar'"), (3.0, "3.0")]
)
def test_only_an_instance_of_a_mechanism_is_added(wrong: object, text: str) -> None:
    with pytest.raises(TypeError, match=rf"heart: {text} is no mechanism; expected an instance: create one"):
        Heart() + wrong  # type: ignore[operator]
    with pytest.raises(TypeError, match="is no mechanism; expected an instance"):
        Heart(mechanisms=(wrong,))  # type: ignore[arg-type]


@pytest.mark.parametrize("period", [829.0, 72.0, 0.0, -0.8, float("nan")])
def test_a_period_in_another_unit_is_refused(period: float) -> None:
    with pytest.raises(InputError, match=r"period = .* s; expected 0\.2 to 3 s: convert it to seconds"):
        Heart(period=period)


def test_a_parameter_of_an_absent_mechanism_names_the_mechanism() -> None:
    with pytest.raises(KeyError, match=r"that the heart lacks: add it, heart \+ MitralRegurgitation\(\)"):
        Heart().with_parameters({"MitralRegurgitation.area": 1e-5})
    with pytest.raises(KeyError, match=r"is unknown; heart\.parameters\(\) lists all"):
        Heart().with_parameters({"zzzzzzzz": 1.0})
    leaking = Heart() + MitralRegurgitation()
    with pytest.raises(KeyError, match=r"is unknown; MitralRegurgitation has MitralRegurgitation\.area"):
        leaking.with_parameters({"MitralRegurgitation.gradient": 1.0})


def test_a_mechanism_of_the_same_name_is_replaced() -> None:
    """A cell that is run again defines another class of the same name."""
    again = type("MitralRegurgitation", (MitralRegurgitation,), {})
    heart = Heart() + MitralRegurgitation() + again(area=3e-5)
    assert [type(m).__name__ for m in heart.mechanisms] == ["AtrialKick", "MitralRegurgitation"]
    assert heart.parameters()["MitralRegurgitation.area"] == 3e-5
