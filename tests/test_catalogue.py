"""The pages that are written from the declarations are in step with them."""

from pathlib import Path

from heartfit.heart.heart import PAPER_PARAMETERS
from heartfit.personalise.setting import declaration, parameter_page
from heartfit.roles import registered

PAGE = Path(__file__).parents[1] / "docs" / "parameters.md"


def test_the_parameter_page_is_in_step():
    assert PAGE.read_text() == parameter_page(), "regenerate: heartfit parameters > docs/parameters.md"


def test_every_mechanism_has_its_rows():
    page = parameter_page()
    assert [name for name in registered() if f"`{name}." not in page] == []


def test_the_paper_s_parameters_have_a_prior():
    page = parameter_page()
    assert [name for name in PAPER_PARAMETERS if declaration(name).sd is None] == []
    assert [name for name in PAPER_PARAMETERS if f".{name}`* |" not in page] == []


def test_a_dotted_path_names_a_parameter():
    assert declaration("circulation.pulmonary_tree.R_p").value != declaration("R_p").value
