"""Rules and scripts of the workflow by their names, and the list of targets in the Snakefile."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
SNAKEFILE = (ROOT / "Snakefile").read_text()
RULES = {file.stem: file.read_text() for file in (ROOT / "workflow" / "rules").glob("*.smk")}
ALL_RULES = "\n".join(RULES.values())


def test_a_script_belongs_to_a_rule_of_its_name():
    scripts = [file.stem for file in (ROOT / "workflow" / "scripts").glob("*.py")]
    assert len(scripts) > 20
    assert not [name for name in scripts if f"rule {name}:" not in ALL_RULES]
    assert not [name for name in scripts if f'"../scripts/{name}.py"' not in ALL_RULES]


def test_functions_of_rules_are_defined_in_workflow_common():
    assert not [name for name, text in RULES.items() if re.search(r"^def ", text, re.MULTILINE)]


def test_the_snakefile_lists_targets_and_all_rule_files():
    targets = re.findall(r"^#   (\w+)", SNAKEFILE, re.MULTILINE)
    assert targets
    assert not [name for name in targets if f"rule {name}:" not in ALL_RULES]
    assert sorted(re.findall(r'"workflow/rules/(\w+)\.smk"', SNAKEFILE)) == sorted(RULES)
