"""Imports that are read from the text are those of the syntax tree."""

import ast
from pathlib import Path

import pytest

import heartfit
from heartfit.core.imports import imported_names

PACKAGE = Path(heartfit.__file__).parent


def names_of_the_tree(source: bytes) -> set[str]:
    names: set[str] = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.ImportFrom) and node.module:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
    return names


def test_the_text_of_every_module_gives_the_imports_of_its_tree():
    for file in PACKAGE.rglob("*.py"):
        source = file.read_bytes()
        ours = {name for name in imported_names(source) if name.startswith("heartfit")}
        assert ours == {name for name in names_of_the_tree(source) if name.startswith("heartfit")}, file


@pytest.mark.parametrize(
    ("source", "names"),
    [
        (b"import a.b, c as d  # e", {"a.b", "c"}),
        (b"from a import b as c, d", {"a", "a.b", "a.d"}),
        (b"from a import (\n    b,  # of c\n    d,\n)\n", {"a", "a.b", "a.d"}),
        (b"if x:\n    from a import \\\n        b\n", {"a", "a.b"}),
    ],
)
def test_statements(source, names):
    assert set(imported_names(source)) == names == names_of_the_tree(source)
