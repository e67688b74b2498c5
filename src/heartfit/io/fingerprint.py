"""Fingerprints of the code behind a result, and versions of the software.

Snakemake watches a script, not the modules that it imports. The fingerprint, a parameter of the rule, closes the gap:
it changes when the script changes, or any module of this package that it imports directly or indirectly. Modules that
are loaded by name at run time, such as the mechanisms of the registry, are not covered; rules that load one add its
own fingerprint.
"""

import platform
from functools import cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from heartfit.core.imports import imported_names

PACKAGE = Path(__file__).resolve().parents[1]


def fingerprint(script: Path) -> str:
    """Sixteen hexadecimal digits over the text of the script and of every module that it imports."""
    digest = sha256(script.read_bytes())
    for module in sorted(modules_below(script)):
        digest.update(module.relative_to(PACKAGE).as_posix().encode() + b"\0" + module.read_bytes())
    return digest.hexdigest()[:16]


def modules_below(script: Path) -> set[Path]:
    """Files of the package that the script imports, directly or indirectly."""
    modules: set[Path] = set()
    pending = {script.resolve()}
    while pending:
        imported = set().union(*map(_imported, pending))
        pending = imported - modules
        modules |= imported
    return modules


@cache
def _imported(file: Path) -> frozenset[Path]:
    return frozenset(path for name in imported_names(file.read_bytes()) for path in _files(name))


def _files(name: str) -> list[Path]:
    """File of a module, and the `__init__` files of the packages that contain it."""
    top, *parts = name.split(".")
    if top != PACKAGE.name:
        return []
    packages = [PACKAGE.joinpath(*parts[:depth], "__init__.py") for depth in range(len(parts) + 1)]
    module = PACKAGE.joinpath(*parts[:-1], f"{parts[-1]}.py") if parts else PACKAGE / "__init__.py"
    return [path for path in (*packages, module) if path.is_file()]


PACKAGES = ("numpy", "scipy", "numba", "SimpleITK", "wildmeshing", "snakemake")


@cache
def versions() -> str:
    """Versions of heartfit, Python and the main packages: "heartfit 0.1.0, Python 3.11.2, numpy 2.3.1"."""
    numbers = {"heartfit": _version("heartfit"), "Python": platform.python_version()}
    numbers |= {name: _version(name) for name in PACKAGES}
    return ", ".join(f"{name} {number}" for name, number in numbers.items())


@cache
def made_by() -> str:
    """Versions, and sixteen hexadecimal digits over all code of this package."""
    digest = sha256()
    for file in sorted(PACKAGE.rglob("*.py")):
        digest.update(file.relative_to(PACKAGE).as_posix().encode() + b"\0" + file.read_bytes())
    return f"{versions()}, code {digest.hexdigest()[:16]}"


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"
