"""The pages that are written from the declarations are in step with them."""

from pathlib import Path

import pytest

from heartfit.catalogue import declared, parameter_page
from heartfit.heart import FOURTEEN
from heartfit.mechanism import registered

PAGE = Path(__file__).parents[1] / "docs" / "parameters.md"


def test_the_parameter_page_is_in_step():
    assert PAGE.read_text() == parameter_page(), "write it anew: heartfit parameters > docs/parameters.md"


def test_every_mechanism_has_its_rows():
    page = parameter_page()
    for name in registered():
        assert f"`{name}." in page


@pytest.mark.parametrize("name", FOURTEEN)
def test_the_paper_s_parameters_have_a_prior(name):
    assert declared(name).sd is not None
    assert f"| {name} * |" in parameter_page()


def test_a_dotted_path_is_a_name_too():
    assert declared("circulation.pulmonary_tree.R_p").value != declared("R_p").value
