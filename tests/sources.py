"""Sources that tests read: syntax trees, each parsed once and not before, and scripts outside the package."""

import ast
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType

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


def script(path: str) -> ModuleType:
    """Module of a script outside the package, executed anew; path: relative to the checkout."""
    spec = spec_from_file_location(Path(path).stem, ROOT / path)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
