"""The page of error messages and the messages of the code belong together."""

import ast
import re
from functools import cache
from pathlib import Path

from tests.sources import PACKAGE, ROOT, nodes, trees_below

PAGE = (ROOT / "docs" / "errors.md").read_text(encoding="utf-8")
GAP = "…"
PHRASES = [
    phrase
    for row in re.findall(r"^\| (`.*?) \| ", PAGE, re.MULTILINE)
    for phrase in re.findall(r"`(.*?)`", row)
]
CONFIGURATION = ("study", "personalise")
"""The rooms whose pydantic validators raise ValueError, which the user reads as InputError."""


def written(node: ast.AST) -> str:
    """A text of the code, a gap for what is put into it."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(map(written, node.values))
    return GAP


def messages(folder: Path, error: str) -> set[str]:
    """Messages of an error in a folder, without texts that are passed on."""
    calls = [
        node
        for tree in trees_below(folder).values()
        for node in nodes(tree)
        if isinstance(node, ast.Call) and node.args
    ]
    raised = {
        written(call.args[0]) for call in calls if isinstance(call.func, ast.Name) and call.func.id == error
    }
    return {text for text in raised if re.search(r"\w", text.replace("expected", ""))}


@cache
def pattern(phrase: str) -> re.Pattern[str]:
    return re.compile(".*".join(map(re.escape, phrase.split(GAP))))


def matches(phrase: str, text: str) -> bool:
    return pattern(phrase).search(text) is not None


def test_every_message_of_the_code_is_on_the_page():
    texts = messages(PACKAGE, "InputError")
    texts |= {text for room in CONFIGURATION for text in messages(PACKAGE / room, "ValueError")}
    untold = [text for text in sorted(texts) if not any(matches(phrase, text) for phrase in PHRASES)]
    assert len(texts) > 200
    assert not untold, "explain them in docs/errors.md"


def test_the_page_lists_no_message_that_the_code_lacks():
    texts = {
        written(node)
        for tree in trees_below(PACKAGE).values()
        for node in nodes(tree)
        if isinstance(node, ast.JoinedStr | ast.Constant)
    }
    assert not [phrase for phrase in PHRASES if not any(matches(phrase, text) for text in texts)]


def test_every_phrase_has_at_least_three_letters():
    assert not [phrase for phrase in PHRASES if len(re.findall(r"\w", phrase)) < 3]
