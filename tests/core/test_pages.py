"""Templates of pages: they are filled, refuse a missing value, and go into the wheel."""

import tomllib
from pathlib import Path

import pytest
from jinja2 import TemplateNotFound, UndefinedError

from heartfit.core import pages

ROOT = Path(__file__).parents[2]
TEMPLATES = sorted((ROOT / "docs" / "templates").glob("*.md.j2"))


def test_a_table_ends_with_its_line_break():
    table = pages.table_row("V_min", 1.5)
    assert table == "| V_min | 1.5 |\n"
    assert pages.render_page("parameters", table=table).endswith(f"|\n{table}")


def test_a_missing_value_is_an_error():
    with pytest.raises(UndefinedError, match="'table' is undefined"):
        pages.render_page("parameters")
    with pytest.raises(TemplateNotFound, match="no_such_page"):
        pages.render_page("no_such_page")


def test_every_template_is_rendered_somewhere():
    sources = [
        path
        for folder in ("src", "benchmarks", "docs", "tests", "verification")
        for path in (ROOT / folder).rglob("*.py")
    ]
    text = "".join(path.read_text() for path in sources if path != Path(__file__))
    unused = [path.name for path in TEMPLATES if f'"{path.name.removesuffix(".md.j2")}"' not in text]
    assert TEMPLATES
    assert not unused


def test_the_wheel_holds_the_templates():
    wheel = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["hatch"]["build"]["targets"]["wheel"]
    (included,) = wheel["force-include"].items()
    checkout, installed = pages.TEMPLATE_FOLDERS
    assert ROOT / included[0] == checkout
    assert included[1] == f"heartfit/{installed.name}"
