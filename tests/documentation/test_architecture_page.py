"""The page of the architecture shows the rooms and the imports of the sources, and names files that exist."""

import re

import pytest

from tests.documentation.blocks import ROOT
from tests.sources import PACKAGE, script, trees_below
from tests.test_architecture import ROOMS, imported_rooms, room_of

PAGE = ROOT / "docs" / "architecture.md"
TEXT = PAGE.read_text(encoding="utf-8")
ROW = re.compile(r"^ *\d+ +(\d+)  (\w+) *([x.]*)$", re.MULTILINE)


@pytest.fixture(scope="module")
def rooms():
    return script("docs/rooms.py")


def drawn_arrows(text):
    """Pairs of rooms, importing and imported, that the picture of a page marks."""
    rows = ROW.findall(text)
    names = {int(number): name for number, name, _ in rows}
    return {
        (name, names[column])
        for _, name, marks in rows
        for column, mark in enumerate(marks, 1)
        if mark == "x"
    }


def arrows_of_the_sources():
    return {
        (room_of(file), lower)
        for file, tree in trees_below(PACKAGE).items()
        for lower in imported_rooms(tree) - {room_of(file)}
        if file != "__init__.py"
    }


def test_each_arrow_of_the_page_is_an_import_and_each_import_an_arrow():
    assert drawn_arrows(TEXT) == arrows_of_the_sources()


def test_the_picture_is_the_drawn_one(rooms):
    assert rooms.draw(*rooms.read_imports()) in TEXT, "python docs/rooms.py"


def test_a_missing_arrow_is_detected():
    line = next(line for line in TEXT.splitlines() if re.search(r" cli .*x$", line))
    assert drawn_arrows(TEXT.replace(line, line[:-1] + ".")) < arrows_of_the_sources()


def test_a_cycle_of_imports_has_no_lowest_room(rooms):
    assert rooms.floor("top", {"top": {"middle"}, "middle": {"bottom"}, "bottom": set()}) == 2
    with pytest.raises(RecursionError):
        rooms.floor("left", {"left": {"right"}, "right": {"left"}})


def test_every_room_has_one_row_that_states_its_purpose():
    table = TEXT.partition("## The rooms")[2].partition("Outside the package:")[0]
    assert sorted(re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE)) == sorted(ROOMS)
