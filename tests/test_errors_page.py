"""The page of error messages quotes messages of the code."""

import ast
import re
from functools import cache

from tests.sources import PACKAGE, ROOT, nodes, trees_below

PAGE = (ROOT / "docs" / "errors.md").read_text(encoding="utf-8")
GAP = "…"
PHRASES = [
    phrase
    for row in re.findall(r"^\| (`.*?) \| ", PAGE, re.MULTILINE)
    for phrase in re.findall(r"`(.*?)`", row)
]


def written(node: ast.AST) -> str:
    """A text of the code, a gap for what is put into it."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(map(written, node.values))
    return GAP


@cache
def pattern(phrase: str) -> re.Pattern[str]:
    return re.compile(".*".join(map(re.escape, phrase.split(GAP))))


def matches(phrase: str, text: str) -> bool:
    return pattern(phrase).search(text) is not None


def test_the_page_lists_no_message_that_the_code_lacks():
    texts = {
        written(node)
        for tree in trees_below(PACKAGE).values()
        for node in nodes(tree)
        if isinstance(node, ast.JoinedStr | ast.Constant)
    }
    assert len(PHRASES) > 60
    assert not [phrase for phrase in PHRASES if not any(matches(phrase, text) for text in texts)]


def test_every_phrase_has_at_least_three_letters():
    assert not [phrase for phrase in PHRASES if len(re.findall(r"\w", phrase)) < 3]
