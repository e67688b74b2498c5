"""What the documentation shows works."""

import re
from pathlib import Path

import pytest

from heartfit.mechanism import registry

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


def test_the_example_of_a_mechanism_is_one(monkeypatch):
    monkeypatch.setattr(registry, "_REGISTRY", {})
    (example,) = re.findall(
        r"```python\n(.*?)```", (ROOT / "docs" / "write_a_mechanism.md").read_text(), re.DOTALL
    )
    names = {"__name__": "example"}
    exec(compile(example, "write_a_mechanism.md", "exec"), names)
    leak = names["SeptalDefect"]()
    assert leak.flow(0.0, 8e3)[0] > 0.0
    assert leak.turned_off().flow(0.0, 8e3)[0] == 0.0


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    links = re.findall(r"\]\((?!https?:)([^)#]+)\)", page.read_text())
    missing = [link for link in links if not (page.parent / link).exists()]
    assert not missing


def test_the_readme_gives_the_commands_that_ci_runs():
    readme, ci = (ROOT / "README.md").read_text(), (ROOT / ".ci" / "run").read_text()
    assert "\npython3 study.py\npython3 study.py test\n" in readme
    assert "step python3 study.py test\n" in ci
