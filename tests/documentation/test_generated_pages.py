"""The sentences of a committed page are those of its template; its numbers are the last measured ones."""

import re
from pathlib import Path

import pytest
from jinja2 import nodes

from heartfit.core import pages

ROOT = Path(__file__).parents[2]
NOT_KEPT = {"forecast"}
"""Templates that are printed only, without a committed page."""
NAMES = [path.name.removesuffix(".md.j2") for path in sorted(pages.TEMPLATE_FOLDERS[0].glob("*.md.j2"))]
COMMITTED = {name: ROOT / ("README.md" if name == "README" else f"docs/{name}.md") for name in NAMES}


def pattern(node: nodes.Node) -> str:
    """A regular expression of every text that a template can give, whatever its values are."""
    if isinstance(node, nodes.TemplateData):
        return re.escape(node.data)
    if isinstance(node, nodes.If):
        branches = [node.body, *([node.else_] if node.else_ else [[]])]
        return f"(?:{'|'.join(''.join(map(pattern, branch)) for branch in branches)})"
    if isinstance(node, nodes.For):
        body, otherwise = (("".join(map(pattern, part))) for part in (node.body, node.else_))
        return f"(?:(?:{body})*{f'|{otherwise}' if otherwise else ''})"
    if isinstance(node, nodes.Template | nodes.Output):
        return "".join(map(pattern, node.body if isinstance(node, nodes.Template) else node.nodes))
    return r"[\s\S]*?"


def sentences(name: str) -> str:
    return pattern(pages._environment().parse((pages.TEMPLATE_FOLDERS[0] / f"{name}.md.j2").read_text()))


@pytest.mark.parametrize("name", sorted(set(NAMES) - NOT_KEPT))
def test_the_sentences_of_a_page_are_those_of_its_template(name):
    page = COMMITTED[name].read_text()
    assert re.fullmatch(sentences(name), page), (
        f"write docs/{name}.md again, or copy its sentences into the template"
    )


def test_a_sentence_changed_by_hand_is_detected():
    page = COMMITTED["mutations"].read_text()
    assert re.fullmatch(sentences("mutations"), page)
    assert not re.fullmatch(
        sentences("mutations"), page.replace("Each row is one change", "A row is a change")
    )
