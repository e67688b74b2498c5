"""What a result was made by: versions of everything that may change its last digit, and the state of the code."""

import platform
from functools import cache
from hashlib import sha256
from importlib.metadata import PackageNotFoundError, version

from heartfit.io.fingerprint import PACKAGE

PACKAGES = ("numpy", "scipy", "numba", "SimpleITK", "wildmeshing", "snakemake")


@cache
def versions() -> str:
    """heartfit, Python and the packages, as "heartfit 0.1.0, Python 3.11.2, numpy 2.3.1"."""
    known = {"heartfit": _version("heartfit"), "Python": platform.python_version()}
    known |= {name: _version(name) for name in PACKAGES}
    return ", ".join(f"{name} {number}" for name, number in known.items())


@cache
def made_by() -> str:
    """The same, and sixteen hexadecimal digits over all code of this package."""
    digest = sha256()
    for file in sorted(PACKAGE.rglob("*.py")):
        digest.update(file.relative_to(PACKAGE).as_posix().encode() + b"\0" + file.read_bytes())
    return f"{versions()}, code {digest.hexdigest()[:16]}"


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"
