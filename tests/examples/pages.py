"""Examples and the pages that show them."""

import re

import pytest

from tests.sources import ROOT

EXAMPLES = ROOT / "examples"
PAGES = {
    **dict.fromkeys(("simulate.py", "diagnose.py", "calibrate.py", "own_mechanism.py"), "python.md"),
    "oscillator.py": "evidence_engine.md",
}
"""Page that shows an example; tests/documentation runs that of the oscillator."""
NUMBER = re.compile(r"[-+]?\d[\d.]*(?:e[-+]?\d+)?")


def shown(name):
    """Text below an example on its page, which the example prints."""
    page = (ROOT / "docs" / PAGES[name]).read_text(encoding="utf-8")
    below = page.partition((EXAMPLES / name).read_text())[2]
    return re.search(r"```text\n(.*?)```", below, re.DOTALL)[1]


def assert_shown(name, printed):
    """The page shows the words that an example prints to the letter, and the numbers to 3 %."""
    assert NUMBER.sub("#", printed).split() == NUMBER.sub("#", shown(name)).split()
    numbers, there = (list(map(float, NUMBER.findall(text))) for text in (printed, shown(name)))
    assert numbers == pytest.approx(there, rel=0.03)
