"""Scripts read, call the library and write; rules are short; all other code belongs into the library."""

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
def test_scripts_have_no_logic(script):
    text = script.read_text()
    tree = ast.parse(text)
    assert text.count("\n") <= 30
    assert ast.get_docstring(tree), "describe the script in one sentence"
    assert not [node for node in ast.walk(tree) if isinstance(node, LOGIC)]


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_a_script_belongs_to_a_rule_of_its_name(script):
    rules = "\n".join(file.read_text() for file in RULES)
    assert f"rule {script.stem}:" in rules
    assert f'"../scripts/{script.name}"' in rules


@pytest.mark.parametrize("file", RULES, ids=lambda file: file.stem)
def test_rules_are_short(file):
    for rule in re.split(r"^rule ", file.read_text(), flags=re.MULTILINE)[1:]:
        lines = rule.split("\n\n")[0].splitlines()
        assert len(lines) <= 25, lines[0]


@pytest.mark.parametrize("file", RULES, ids=lambda file: file.stem)
def test_shared_code_of_rules_is_defined_once(file):
    assert not re.search(r"^def ", file.read_text(), flags=re.MULTILINE), "define it in workflow/common"


def test_the_snakefile_lists_targets_and_all_rule_files():
    text = (ROOT / "Snakefile").read_text()
    rules = "\n".join(file.read_text() for file in RULES)
    targets = re.findall(r"^#   (\w+)", text, flags=re.MULTILINE)
    assert targets
    assert not [name for name in targets if f"rule {name}:" not in rules]
    assert sorted(re.findall(r'"workflow/rules/(\w+)\.smk"', text)) == [file.stem for file in RULES]
    assert text.count("\n") <= 60
