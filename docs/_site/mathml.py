"""Formulas as MathML, which browsers show by themselves: nothing is fetched and no script runs."""

import re

from docutils.nodes import SkipNode
from latex2mathml.converter import convert
from sphinx.util import logging

ENVIRONMENT = re.compile(r"\\begin{(\w+)}.*?\\end{\1}", re.DOTALL)
UNKNOWN = re.compile(r"<mi>(\\\w+|&)</mi>")
"""What stands in the result where the converter does not know a command."""


def setup(app):
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True}


def inline(writer, node):
    writer.body.append(shown(node, node.astext(), "inline"))
    raise SkipNode


def block(writer, node):
    writer.body.append(f'<div class="formula">{shown(node, aligned(node.astext()), "block")}</div>')
    raise SkipNode


def aligned(text):
    """Lines that are aligned or broken stand in a block for that."""
    outside = ENVIRONMENT.sub("", text)
    return rf"\begin{{split}}{text}\end{{split}}" if "&" in outside or r"\\" in outside else text


def shown(node, text, display):
    formula = convert(text, display=display)
    if UNKNOWN.search(formula):
        logging.getLogger(__name__).warning("formula with an unknown command: %s", text, location=node)
    return formula
