"""Site of the pages: formulas, navigation, and prose in docstrings."""

import sys
from importlib import import_module
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "docs" / "_site"))
mathml, navigation, prose = map(import_module, ("mathml", "navigation", "prose"))


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        ("a rate |u|_+ of n * m", r"a rate \|u\|_+ of n \* m"),
        ("the stress u_ at the end", r"the stress u\_ at the end"),
        ("`x_` and :math:`|u|` and ``a * b``", "`x_` and :math:`|u|` and ``a * b``"),
        ("k_RS and k_0", "k_RS and k_0"),
    ],
)
def test_marks_of_prose_are_kept_and_those_of_roles_left(text, kept):
    assert prose.plain(text) == kept


def test_a_formula_of_a_docstring_is_unchanged():
    lines = ["A norm |x|.", "", ".. math:: |x| =", "", "          a * b", "", "Then |y|."]
    prose.keep_marks(None, "module", "name", None, {}, lines)
    assert lines == [r"A norm \|x\|.", "", ".. math:: |x| =", "", "          a * b", "", r"Then \|y\|."]


def test_sections_of_the_index_become_captions():
    source = ["# Title\n\n## Run\n\n- [A](a.md): one\n- [B](b/README.md): two\n"]
    navigation.add_navigation(None, "index", source)
    assert "```{toctree}\n:hidden:\n:caption: Run\n\na\nb/README\n```" in source[0]


def test_formulas_are_mathml_and_lines_that_are_aligned_stand_below_each_other():
    assert mathml.aligned("a = b") == "a = b"
    formula = mathml.convert(mathml.aligned(r"a &= b \\ &= c"))
    assert formula.startswith("<math")
    assert formula.count("<mtr>") == 2


@pytest.mark.parametrize(
    "array",
    [
        "ndarray[tuple[Any, ...], dtype[float64]]",
        "~numpy.ndarray[tuple[~typing.Any, ...], ~numpy.dtype[~numpy.float64]]",
    ],
)
def test_a_signature_names_arrays_as_the_code_does(array):
    named = prose.name_arrays(None, "function", "f", None, {}, f"(x: {array}, n: int)", None)
    assert named == ("(x: Floats, n: int)", None)
