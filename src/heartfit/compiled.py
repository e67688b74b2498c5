"""Where compiled kernels are kept.

numba compiles a kernel anew when its own file has changed, not when that of another has, which it inlines: a beat would
go on with the valves of an older version. So kernels of other sources have another folder.
"""

from hashlib import blake2s
from pathlib import Path

INLINED = ("branch.py", "circulation/**/*.py", "mechanics/**/*.py", "sphere/**/*.py")
"""Sources of kernels that are part of others."""


def folder_of_kernels(package: Path) -> Path:
    """The folder for the kernels of the sources that stand in ``package`` now, told by their sizes and dates."""
    sources = sorted(file for pattern in INLINED for file in package.glob(pattern))
    known = [(file.relative_to(package).as_posix(), file.stat()) for file in sources]
    state = repr([(name, stat.st_size, stat.st_mtime_ns) for name, stat in known])
    return package / "__pycache__" / f"kernels-{blake2s(state.encode(), digest_size=6).hexdigest()}"
