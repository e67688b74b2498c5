"""Examples, links and commands of the documentation work."""

import re
from pathlib import Path

import numpy as np
import pytest

from heartfit.heart.heart import Heart
from heartfit.roles import registry
from tests.documentation.blocks import pages_of

ROOT = Path(__file__).parents[1]
PAGES = [
    ROOT / "README.md",
    ROOT / "CHANGELOG.md",
    ROOT / "CONTRIBUTING.md",
    *pages_of("config"),
    *pages_of("docs"),
    *pages_of("studies"),
]


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


def test_the_page_of_mechanisms_states_the_time_of_the_r_wave():
    trigger, peak = Heart().trigger, 0.55
    text = (ROOT / "docs" / "write_a_mechanism.md").read_text()
    assert f"{trigger:g} s before the R wave" in text
    assert f"a peak at {peak:g} s lies {peak - trigger:g} s after the R wave" in text


def anchors(page):
    """The headings of a page as links name them."""
    headings = re.findall(r"^#+ (.+)$", page.read_text(), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def dead_links(page):
    """Relative links of a page whose file or heading does not exist."""
    for link, anchor in re.findall(r"\]\((?!https?:)([^)#]*)#?([^)]*)\)", page.read_text()):
        target = page.parent / link if link else page
        if not target.exists() or (anchor and anchor not in anchors(target)):
            yield f"{page.name}: {link}#{anchor}"


def test_every_link_leads_to_a_file_and_a_heading():
    assert [link for page in PAGES for link in dead_links(page)] == []


def test_dead_links_are_listed(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("# One\n\n[a](page.md#one) [b](page.md#two) [c](nowhere.md) [d](#one) [e](#three)\n")
    assert list(dead_links(page)) == ["page.md: page.md#two", "page.md: nowhere.md#", "page.md: #three"]


def test_every_page_is_in_the_index_once():
    docs = ROOT / "docs"
    listed = re.findall(r"\]\(([\w/]+\.md)\)", (docs / "index.md").read_text())
    pages = {page.name for page in docs.glob("*.md")} - {"index.md"}
    assert sorted(listed) == sorted(pages | {"decisions/README.md"})


def commands_of_study(text):
    """Commands of study.py that start a line of a text, `run` where none is named."""
    return {
        command or "run"
        for command in re.findall(
            r"^ *(?:step )?(?:in_bare_clone )?python3 study\.py ?(\w*)", text, re.MULTILINE
        )
    }


def test_the_readme_and_ci_give_commands_that_exist_and_both_run_the_tests():
    known = set(re.findall(r'^    "(\w+)": \w+,$', (ROOT / "study.py").read_text(), re.MULTILINE))
    readme, ci = (commands_of_study((ROOT / name).read_text()) for name in ("README.md", ".ci/run"))
    assert {"run", "test"} <= readme & ci
    assert "smoke" in ci
    assert (readme | ci) - known == set()
