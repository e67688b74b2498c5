"""Scripts read, call the library and write; rules are short; everything else belongs into the library."""

import ast
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SCRIPTS = sorted((ROOT / "workflow" / "scripts").glob("*.py"))
RULES = sorted((ROOT / "workflow" / "rules").glob("*.smk"))
LOGIC = (
    ast.FunctionDef,
    ast.ClassDef,
    ast.Lambda,
    ast.For,
    ast.While,
    ast.If,
    ast.IfExp,
    ast.Try,
    ast.comprehension,
)


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_a_script_holds_no_logic(script):
    text = script.read_text()
    tree = ast.parse(text)
    assert text.count("\n") <= 30
    assert ast.get_docstring(tree), "say in one sentence what it does"
    assert not [node for node in ast.walk(tree) if isinstance(node, LOGIC)]


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_a_script_belongs_to_a_rule_of_its_name(script):
    rules = "\n".join(file.read_text() for file in RULES)
    assert f"rule {script.stem}:" in rules
    assert f'"../scripts/{script.name}"' in rules


@pytest.mark.parametrize("file", RULES, ids=lambda file: file.stem)
def test_rules_are_short_and_fingerprinted(file):
    for rule in re.split(r"^rule ", file.read_text(), flags=re.MULTILINE)[1:]:
        lines = rule.rstrip().splitlines()
        name = lines[0].rstrip(":")
        assert len(lines) <= 25, name
        assert "    log:" in lines, name
        assert f'code=code("{name}.py"),' in rule or name == "fetch_measured_heart", name


@pytest.mark.parametrize("file", RULES, ids=lambda file: file.stem)
def test_what_rules_share_is_defined_in_one_place(file):
    assert not re.search(r"^def ", file.read_text(), flags=re.MULTILINE), "it belongs into workflow/common"


def test_the_snakefile_is_a_table_of_contents():
    assert (ROOT / "Snakefile").read_text().count("\n") <= 40
