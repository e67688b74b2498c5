"""Every source file and module that a page names exists."""

import re

import pytest

from tests.documentation.blocks import ROOT, pages_of

PAGES = [ROOT / "README.md", *pages_of("config"), *pages_of("docs"), *pages_of("studies")]
FILE = re.compile(r"`([\w./-]+/[\w.-]+\.(?:py|smk|yaml|tsv|toml|j2))`")
MODULE = re.compile(r"(?<!/)heartfit((?:\.\w+)+)")
PLACES = (ROOT, ROOT / "src" / "heartfit", ROOT / "src", ROOT / "docs")
MADE = ("results/", "config/mine.")
"""Folders made by a study or supplied by a reader."""


def missing_files(text):
    """Source files that a text quotes by path and that do not exist."""
    return [
        path
        for path in FILE.findall(text)
        if not path.startswith(MADE) and not any((place / path).exists() for place in PLACES)
    ]


def missing_modules(text):
    """Dotted names of the package in a text that are no module."""
    return [name for name in MODULE.findall(text) if not leads_to_a_module(name[1:].split("."))]


def leads_to_a_module(parts):
    """True for a folder or file of the package, and for constants, functions and classes in it."""
    place = ROOT / "src" / "heartfit"
    for position, part in enumerate(parts):
        if (place / part).is_dir():
            place = place / part
        elif (place / f"{part}.py").is_file():
            rest = parts[position + 1 :]
            source = (place / f"{part}.py").read_text(encoding="utf-8")
            return not rest or re.search(rf"\b{rest[0]}\b", source) is not None
        else:
            return place != ROOT / "src" / "heartfit" and part in (place / "__init__.py").read_text()
    return True


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_files_and_modules_that_a_page_names_exist(page):
    text = page.read_text(encoding="utf-8")
    assert missing_files(text) == []
    assert missing_modules(text) == []


def test_a_file_and_a_module_that_do_not_exist_are_noticed():
    assert missing_files("`geometry/mesh.py` `geometry/gone.py` `results/mine.tsv`") == ["geometry/gone.py"]
    assert missing_modules("heartfit.geometry.mesh.VentricularMesh heartfit.geometry.gone heartfit.gone") == [
        ".geometry.gone",
        ".gone",
    ]


def test_modules_that_the_theory_names_exist():
    text = (ROOT / "docs" / "theory.md").read_text(encoding="utf-8")
    names = re.findall(r"`([a-z_]+(?:\.[a-z_]+)+)`", text)
    assert len(names) > 10
    assert [name for name in names if not leads_to_a_module(name.split("."))] == []
