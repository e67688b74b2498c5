"""What the documentation shows works."""

import re
from pathlib import Path

import numpy as np
import pytest

from heartfit.mechanism import registry

ROOT = Path(__file__).parents[1]
PAGES = [ROOT / "README.md", ROOT / "config" / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]


def test_the_example_of_a_mechanism_is_one(monkeypatch):
    monkeypatch.setattr(registry, "_REGISTRY", {})
    example = re.search(
        r"```python\n(.*?)```", (ROOT / "docs" / "write_a_mechanism.md").read_text(), re.DOTALL
    )
    names = {"__name__": "example"}
    exec(compile(example[1], "write_a_mechanism.md", "exec"), names)
    pump = names["BalloonPump"]()
    times = np.linspace(0.0, 0.8, 81)
    assert pump.pressure("aorta", times, 0.8).max() == pytest.approx(pump.rise)
    assert not pump.turned_off().pressure("aorta", times, 0.8).any()


def anchors(page):
    """The headings of a page as links name them."""
    headings = re.findall(r"^#+ (.+)$", page.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for link, anchor in re.findall(r"\]\((?!https?:)([^)#]*)#?([^)]*)\)", page.read_text()):
        target = page.parent / link if link else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), anchor


def test_every_page_stands_in_the_index_once():
    docs = ROOT / "docs"
    listed = re.findall(r"\]\(([\w/]+\.md)\)", (docs / "index.md").read_text())
    pages = {page.name for page in docs.glob("*.md")} - {"index.md"}
    assert sorted(listed) == sorted(pages | {"decisions/README.md"})


def test_the_readme_gives_the_commands_that_ci_runs():
    readme, ci = (ROOT / "README.md").read_text(), (ROOT / ".ci" / "run").read_text()
    assert "\npython3 study.py\npython3 study.py test\n" in readme
    assert "step python3 study.py test\n" in ci
