"""Compiled kernels that numba keeps, and which of them a power failure cut off: numba would stumble over them for ever.

Each file is a sequence of pickles, whose form is looked at without loading them.
"""

import pickletools
from io import BytesIO
from pathlib import Path


def cut_off(folder: Path) -> list[Path]:
    """Kept files that are empty or end in the middle of a pickle."""
    return [file for file in sorted(Path(folder).rglob("*.nb[ci]")) if not _is_whole(file.read_bytes())]


def _is_whole(content: bytes) -> bool:
    stream = BytesIO(content)
    try:
        while stream.tell() < len(content):
            for _ in pickletools.genops(stream):
                pass  # up to the end of this pickle
    except (ValueError, EOFError):
        return False
    return len(content) > 0
