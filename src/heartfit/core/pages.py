"""Markdown pages: docs/templates holds the sentences, the caller gives numbers and tables."""

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from jinja2 import Environment

PACKAGE = Path(__file__).parents[1]
TEMPLATE_FOLDERS = (PACKAGE.parents[1] / "docs" / "templates", PACKAGE / "page_templates")
"""Folders of templates: of a checkout, and of an installed wheel, which holds a copy."""


def render_page(name: str, **values: object) -> str:
    """Return the page docs/templates/<name>.md.j2 filled with values.

    A table is Markdown text that ends with a line break. Raises jinja2.TemplateNotFound for a name without a
    template, jinja2.UndefinedError for a value that the template asks for and the caller does not give.
    """
    return _environment().get_template(f"{name}.md.j2").render(values)


def table_row(*cells: object) -> str:
    """Return one line of a Markdown table, with its line break."""
    return f"| {' | '.join(map(str, cells))} |\n"


@cache
def _environment() -> "Environment":
    from jinja2 import Environment, FileSystemLoader, StrictUndefined  # most jobs render no template

    return Environment(
        loader=FileSystemLoader(TEMPLATE_FOLDERS),
        undefined=StrictUndefined,
        autoescape=False,  # Markdown
        trim_blocks=True,
        keep_trailing_newline=True,
    )
