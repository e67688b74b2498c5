"""Every file is written as a draft that is renamed when it is complete, read from the syntax tree."""

import ast
from pathlib import Path

IO = Path(__file__).parents[2] / "src" / "heartfit" / "io"
FOUNDATION = "files.py"
"""Module that provides the drafts."""
WRITING = {
    "write_text",
    "write_bytes",
    "savez",
    "savez_compressed",
    "savefig",
    "WriteImage",
    "save",
    "to_netcdf",
}


def writes(node):
    """True for a call that writes to a file: a method of such a name, or opening a file for writing."""
    if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
        return False
    modes = [argument.value for argument in node.args if isinstance(argument, ast.Constant)]
    to_write = node.func.attr == "open" and any(str(mode)[:1] in "wax" for mode in modes)
    return node.func.attr in WRITING or to_write


def drafted(tree):
    """The nodes within a block that begins with `with replacing(...)`."""
    for block in ast.walk(tree):
        if isinstance(block, ast.With):
            calls = [item.context_expr for item in block.items if isinstance(item.context_expr, ast.Call)]
            if any(getattr(call.func, "id", "") == "replacing" for call in calls):
                yield from ast.walk(block)


def test_writes_outside_a_draft_are_listed():
    source = (
        "with replacing(path) as draft:\n    a.savefig(draft)\nb.savefig(path)\nc.open('wb')\nd.open('rb')"
    )
    tree = ast.parse(source)
    assert [node.lineno for node in ast.walk(tree) if writes(node)] == [3, 4, 2]
    assert [node.lineno for node in drafted(tree) if writes(node)] == [2]
    assert undrafted(tree) == [3, 4]


def undrafted(tree):
    """Lines that write to a file outside a `with replacing(path) as draft` block."""
    known = set(map(id, drafted(tree)))
    return [node.lineno for node in ast.walk(tree) if writes(node) and id(node) not in known]


def test_every_file_is_written_as_a_draft():
    files = sorted(IO.rglob("*.py"))
    offenders = {file.name: lines for file in files if (lines := undrafted(ast.parse(file.read_text())))}
    (checksum,) = offenders.pop(FOUNDATION)
    assert "fresh.write_text" in (IO / FOUNDATION).read_text().splitlines()[checksum - 1]
    assert not offenders, "write within `with replacing(path) as draft`"
