"""A fingerprint of all code that a script rests on.

Snakemake watches a script, not the modules it imports. The fingerprint, given as a rule's parameter, closes
the gap: it changes when the script or any module of this package that it imports, directly or not, does.
A module that is only loaded by name while running, as a mechanism of the registry, is not seen; the rules that
load one add its own fingerprint.
"""

import ast
import hashlib
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1]


def fingerprint(script: Path) -> str:
    """Sixteen hexadecimal digits over the text of the script and of every module it rests on."""
    digest = hashlib.sha256(script.read_bytes())
    for module in sorted(modules_below(script)):
        digest.update(module.relative_to(PACKAGE).as_posix().encode() + b"\0" + module.read_bytes())
    return digest.hexdigest()[:16]


def modules_below(script: Path) -> set[Path]:
    """Files of the package that the script imports, directly or not."""
    found: set[Path] = set()
    waiting = {script.resolve()}
    while waiting:
        reached = set().union(*map(_imported, waiting))
        waiting = reached - found
        found |= reached
    return found


@cache
def _imported(file: Path) -> frozenset[Path]:
    names: set[str] = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            names |= {node.module, *(f"{node.module}.{alias.name}" for alias in node.names)}
        elif isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
    return frozenset(path for name in names for path in _files(name))


def _files(name: str) -> list[Path]:
    """The file of a module, with the packages that are run on the way to it."""
    top, *parts = name.split(".")
    if top != PACKAGE.name:
        return []
    packages = [PACKAGE.joinpath(*parts[:depth], "__init__.py") for depth in range(len(parts) + 1)]
    module = PACKAGE.joinpath(*parts[:-1], f"{parts[-1]}.py") if parts else PACKAGE / "__init__.py"
    return [path for path in (*packages, module) if path.is_file()]
