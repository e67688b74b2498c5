"""Cache folder of numba's compiled kernels.

numba recompiles a kernel when its own file has changed, but not when another file has changed whose function it inlines
or whose constant it froze: a beat would go on with the valves of an older version. So each state of the sources of all
kernels has a folder of its own.
"""

import re
from collections.abc import Iterator
from hashlib import blake2s
from pathlib import Path

from heartfit.core.imports import imported_names

IMPORTS_NUMBA = re.compile(rb"^\s*(?:from\s+numba\b|import\s.*\bnumba\b)", re.MULTILINE)


def kernel_folder(package: Path) -> Path:
    """Return the folder for the kernels of the present sources of ``package``, identified by their sizes and dates."""
    stamps = [(file.relative_to(package).as_posix(), file.stat()) for file in kernel_sources(package)]
    state = repr([(name, stat.st_size, stat.st_mtime_ns) for name, stat in stamps])
    return package / "__pycache__" / f"kernels-{blake2s(state.encode(), digest_size=6).hexdigest()}"


def kernel_sources(package: Path) -> list[Path]:
    """Return the sorted modules of ``package`` that a compiled kernel may depend on.

    These are the modules that import numba, and the modules of the package that those import, directly or through
    others: functions are inlined from there, constants are frozen from there. The imports are read from the text of
    the sources, as importing them would need the folder already; imports relative to a module are not followed.
    """
    texts = {file: file.read_bytes() for file in package.rglob("*.py")}
    queue = [file for file, text in texts.items() if b"numba" in text and IMPORTS_NUMBA.search(text)]
    sources = set(queue)
    while queue:
        modules = {
            file for name in imported_names(texts[queue.pop()]) for file in _module_files(package, name)
        }
        new = (modules & texts.keys()) - sources
        sources |= new
        queue += new
    return sorted(sources)


def _module_files(package: Path, name: str) -> Iterator[Path]:
    """Yield the files that a module of this dotted name may have below ``package``."""
    root, *parts = name.split(".")
    if root == package.name:
        path = package.joinpath(*parts)
        yield from (path.with_suffix(".py"), path / "__init__.py")
