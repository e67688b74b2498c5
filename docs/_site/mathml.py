"""Formulas as MathML, which browsers show by themselves: nothing is fetched and no script runs."""

from docutils.nodes import SkipNode
from latex2mathml.converter import convert


def setup(app):
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True}


def inline(writer, node):
    writer.body.append(convert(node.astext()))
    raise SkipNode


def block(writer, node):
    writer.body.append(f'<div class="formula">{convert(aligned(node.astext()), display="block")}</div>')
    raise SkipNode


def aligned(text):
    """Lines that begin and break as in LaTeX's align stand in such a block."""
    return rf"\begin{{aligned}}{text}\end{{aligned}}" if "&" in text or r"\\" in text else text
