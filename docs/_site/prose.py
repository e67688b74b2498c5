"""Docstrings are prose with formulas: a bar, a star or a last underscore outside of a role stands for itself.

Signatures name arrays of numbers as the code does.
"""

import re

QUOTED = re.compile(r"(``.*?``|(?::\w+:)?`[^`]*`)")
MARK = re.compile(r"(?<!\\)([|*])|(?<=\w)(_)(?!\w)")
ARRAYS = {"float64": "Floats", "int64": "Integers", "str_": "Names"}
PLACE = r"~?(?:\w+\.)?"
ARRAY = re.compile(rf"{PLACE}ndarray\[tuple\[{PLACE}Any, \.\.\.\], {PLACE}dtype\[{PLACE}(\w+)\]\]")


def setup(app):
    app.connect("autodoc-process-docstring", keep_marks)
    app.connect("autodoc-process-signature", name_arrays)
    return {"parallel_read_safe": True}


def keep_marks(*given):
    lines, inside = given[-1], False
    for number, line in enumerate(lines):
        inside = line.startswith("..") or (inside and (not line or line.startswith(" ")))
        if not inside:
            lines[number] = plain(line)


def plain(line):
    """The line with its marks escaped, but for what is quoted: every other part of the split."""
    parts = QUOTED.split(line)
    parts[::2] = [MARK.sub(r"\\\g<0>", part) for part in parts[::2]]
    return "".join(parts)


def name_arrays(*given):
    return tuple(
        text and ARRAY.sub(lambda found: ARRAYS.get(found[1], "ndarray"), text) for text in given[-2:]
    )
