"""Syntax trees of the sources, each parsed once for all tests that read it, and not before."""

import ast
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "src" / "heartfit"


@cache
def tree_of(file: Path) -> ast.Module:
    """Syntax tree of a file, which no test may change."""
    return ast.parse(file.read_text(encoding="utf-8"))


def trees_below(folder: Path) -> dict[str, ast.Module]:
    """Syntax trees by path relative to the folder."""
    return {file.relative_to(folder).as_posix(): tree_of(file) for file in sorted(folder.rglob("*.py"))}


@cache
def nodes(tree: ast.AST) -> tuple[ast.AST, ...]:
    """All nodes of a syntax tree."""
    return tuple(ast.walk(tree))
