"""Language of the sources: docstrings open with their subject, identifiers name an element, a value or a role."""

import ast
import re
from collections.abc import Iterator

from tests.sources import ROOT, nodes, tree_of

FOLDERS = ("src/heartfit", "verification", "workflow", "benchmarks", "tests")
FILES = [ROOT / "study.py", *(file for folder in FOLDERS for file in sorted((ROOT / folder).rglob("*.py")))]

RIDDLE = re.compile(r"(What|How|Where|When|Which|Whether|Who|Whose|Why|Of|That|As)\b")

VAGUE = {"each", "every", "found", "said", "told", "seen", "asked", "given", "made", "done", "gone"}
VAGUE |= {"moved", "joined", "apart", "doubt", "rival", "twin", "twins", "outsider", "outsiders", "promise"}
VAGUE |= {"SHORT", "SLIGHT", "FRESH", "ROUGH", "FEW", "MOST", "ENOUGH", "SAME", "ONE", "APART", "NEAR"}
"""Pronouns, bare participles and adjectives, and terms that the field does not use."""

FROZEN = {
    ("src/heartfit/study/discovery.py", "each"),
    ("src/heartfit/study/discovery.py", "outsiders"),
}
"""Keys of the configuration."""


def docstrings(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Line and text of all docstrings: of modules, classes, functions and, after an assignment, attributes."""
    for node in nodes(tree):
        match node:
            case ast.Expr(value=ast.Constant(value=str(text))):
                yield node.lineno, text.strip()


def definitions(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Line and name of all functions, classes, arguments, variables and attributes that a source defines."""
    for node in nodes(tree):
        match node:
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name) | ast.arg(arg=name):
                yield node.lineno, name
            case ast.Name(id=name, ctx=ast.Store()) | ast.Attribute(attr=name, ctx=ast.Store()):
                yield node.lineno, name


def test_docstrings_open_with_their_subject():
    riddles = [
        f"{file}:{line}: {text.splitlines()[0]}"
        for file in FILES
        for line, text in docstrings(tree_of(file))
        if RIDDLE.match(text)
    ]
    assert not riddles


def test_identifiers_name_an_element_a_value_or_a_role():
    vague = [
        f"{file}:{line}: {name}"
        for file in FILES
        for line, name in definitions(tree_of(file))
        if name in VAGUE and (file.relative_to(ROOT).as_posix(), name) not in FROZEN
    ]
    assert not vague
